#include "calibrate/experiment/simulate_experiment.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "base/input_error.h"
#include "calibrate/experiment/draw_down_front.h"
#include "calibrate/experiment/heap_angle.h"
#include "dem/engine/unstable_run.h"
#include "dem/experiment/experiment_table.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {
namespace {

using Clock = std::chrono::steady_clock;

/// Maximum work lost by a kill, apart from the time until the next check.
constexpr std::chrono::seconds kBetweenRestarts{60};
/// Of the whole work, if there are pictures to measure.
constexpr double kSimulationFraction = .95;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class ExperimentRunner {
 public:
  ExperimentRunner(const RunSpec& spec, std::uint64_t seed, const SimulateOptions& options)
      : spec_(spec), seed_(seed), options_(options) {}

  RunResult run() {
    std::optional<RunResult> saved = reusable();
    RunResult run = saved ? *std::move(saved) : simulated();
    run.definition = spec_.definition;
    if (!run.failure.empty()) return run;
    if (spec_.viewing.views == 0) {
      run.views.clear();
    } else if (!is_pictured_as(run, spec_.viewing)) {
      take_pictures(run);
    }
    return run;
  }

 private:
  /// From the folder, if nothing has to be simulated again.
  std::optional<RunResult> reusable() const {
    if (options_.folder == nullptr) return std::nullopt;
    std::optional<RunResult> run = options_.folder->find(spec_, seed_);
    if (!run || !run->failure.empty()) return run;
    if (!has_definition(*run, spec_.definition)) return std::nullopt;
    const bool has_film =
        !options_.trajectory || run->trajectory_s == options_.trajectory->interval_s;
    const bool needs_state = options_.saves_state || !is_pictured_as(*run, spec_.viewing);
    if (!has_film || (needs_state && !options_.folder->has_state(spec_, seed_))) {
      return std::nullopt;
    }
    return run;
  }

  RunResult simulated() {
    RunResult run;
    run.seed = seed_;
    run.simulated = description_of(spec_, seed_);
    if (options_.trajectory) run.trajectory_s = options_.trajectory->interval_s;
    const std::optional<SavedRestart> restart = usable_restart();
    const double spent_s = restart ? restart->record.wall_s : 0;
    start_ = Clock::now();
    try {
      static_cast<dem::Repeat&>(run) = repeated(restart, spent_s);
      if (!run.envelopes.empty()) add_position_angle(run);
      run.failure = no_heap_reason(run);
      if (spec_.entry().front != nullptr) measure_front(spec_.entry().front(spec_.protocol), run);
    } catch (const base::InputError& error) {
      throw dem::with_study_keys(error, spec_.protocol);
    } catch (const dem::NoMeasurement& error) {
      run.failure = error.what();
    } catch (const dem::UnstableRun& error) {
      run.failure = error.what();
    }
    run.wall_s = spent_s + seconds_since(start_);
    save(run);
    return run;
  }

  bool keeps_restarts() const {
    return options_.folder != nullptr && spec_.entry().resume != nullptr &&
           spec_.simulator->can_resume();
  }

  /// A restart without the requested film is useless.
  std::optional<SavedRestart> usable_restart() const {
    if (!keeps_restarts()) return std::nullopt;
    std::optional<SavedRestart> restart = options_.folder->find_restart(spec_, seed_);
    if (restart && options_.trajectory &&
        restart->record.trajectory_s != options_.trajectory->interval_s) {
      restart.reset();
    }
    return restart;
  }

  dem::Repeat repeated(const std::optional<SavedRestart>& restart, double spent_s) {
    std::optional<dem::TrajectoryWriter> film;
    dem::RunRecord record;
    if (options_.trajectory) {
      film.emplace(options_.trajectory->folder, options_.trajectory->interval_s,
                   description_of(spec_, seed_), restart ? restart->record.film : dem::Film{});
      record.frame_interval_s = options_.trajectory->interval_s;
      record.frame = [&](const dem::Simulation& simulation) { film->add(simulation); };
    }
    Clock::time_point saved_at = start_;
    if (keeps_restarts()) {
      record.is_restart_due = [&] { return Clock::now() - saved_at >= kBetweenRestarts; };
      record.save_restart = [&](const dem::Simulation& simulation,
                                const dem::RunProgress& progress) {
        RestartRecord now{.progress = progress, .film = {}, .trajectory_s = {}};
        if (film) {
          now.film = film->film();
          now.trajectory_s = options_.trajectory->interval_s;
        }
        now.wall_s = spent_s + seconds_since(start_);
        options_.folder->save_restart(spec_, seed_, simulation, now);
        saved_at = Clock::now();
      };
    }
    if (options_.watch_work) {
      record.is_restart_due = [] { return true; };
      record.save_restart = [&](const dem::Simulation&, const dem::RunProgress& progress) {
        options_.watch_work(progress.work.clump_steps);
      };
    }
    const double whole = spec_.viewing.views > 0 ? kSimulationFraction : 1;
    return spec_.simulator->run(
        {.spec = spec_,
         .seed = seed_,
         .folder = options_.folder == nullptr ? std::filesystem::path()
                                              : options_.folder->work_folder(spec_, seed_),
         .goes_on = [&](double fraction) { return goes_on(whole * fraction); },
         .record = record,
         .from = restart ? &restart->from : nullptr});
  }

  bool goes_on(double fraction) const { return !options_.report || options_.report(fraction); }

  void measure_front(const dem::BoxesFront& boxes, RunResult& run) const {
    const DrawDownFront front = draw_down_front(scene(run), boxes);
    run.readings["upper_angle_deg"] = front.upper_angle_deg;
    run.readings["lower_angle_deg"] = front.lower_angle_deg;
  }

  /// Saves the state first: a run only exists once all of it does.
  void save(const RunResult& run) const {
    if (options_.folder == nullptr) return;
    if (run.state && (options_.saves_state || spec_.entry().is_pictured)) {
      dem::write_state(options_.folder->state_file(spec_, seed_), *run.state, run.simulated);
    }
    options_.folder->save(spec_, run);
    options_.folder->remove_restart(spec_, seed_);
  }

  render::Scene scene(const RunResult& run) const {
    if (run.state) return render::scene_of(*run.state);
    return render::scene_of(dem::read_state(options_.folder->state_file(spec_, seed_)));
  }

  /// Pictures that could not be drawn are not saved: another machine may draw them.
  void take_pictures(RunResult& run) const {
    run.views.clear();
    run.camera = spec_.viewing.camera;
    try {
      run.views = measure_views(
          HeapViewSession(scene(run), spec_.viewing), spec_.model.threads, [&](double fraction) {
            return goes_on(kSimulationFraction + (1 - kSimulationFraction) * fraction);
          });
    } catch (const dem::Interrupted&) {
      throw;
    } catch (const std::runtime_error& error) {
      run.picture_error = error.what();
      return;
    }
    if (options_.folder != nullptr) options_.folder->save(spec_, run);
  }

  const RunSpec& spec_;
  std::uint64_t seed_;
  const SimulateOptions& options_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

RunResult simulate_experiment(const RunSpec& spec, std::uint64_t seed,
                              const SimulateOptions& options) {
  RunResult run = ExperimentRunner(spec, seed, options).run();
  run.state.reset();  // saved if requested
  return run;
}

}  // namespace repose::calibrate
