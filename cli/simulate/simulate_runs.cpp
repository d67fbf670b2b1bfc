#include "cli/simulate/simulate_runs.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "calibrate/study/position_angle.h"
#include "cli/simulate/simulate_json.h"
#include "cli/simulate/simulate_progress.h"
#include "cli/simulate/simulate_saved.h"
#include "dem/engine/unstable_run.h"
#include "dem/state/state_file.h"
#include "dem/state/trajectory.h"

namespace repose::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// What a kill at any moment costs at most, but for the time to the next look.
constexpr std::chrono::seconds kBetweenRestartPoints{60};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Threads that work on one repeat: those that are left over when each has one.
int threads_each(const SimulatePlan& plan, std::size_t repeats) {
  return std::max(1, plan.threads / static_cast<int>(std::max<std::size_t>(1, repeats)));
}

class Batch {
 public:
  Batch(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted)
      : plan_(plan),
        model_(plan.model),
        is_interrupted_(is_interrupted),
        progress_(plan.seeds.size()) {}

  /// Of each repeat's simulation.
  void set_threads(int threads) { model_.threads = threads; }

  /// What an earlier call has finished.
  Run saved(std::size_t index) {
    return guarded([&](Run& run) {
      if (auto saved = saved_run(plan_, plan_.seeds[index])) run = *std::move(saved);
      if (run.outcome == RunOutcome::done) progress_.tell(index, 1);
    });
  }

  Run run(std::size_t index) {
    if (is_broken_off()) return {};
    return guarded([&](Run& run) { simulate(index, run); });
  }

  bool is_broken_off() const { return is_interrupted_ || has_failed_; }

 private:
  /// Whatever goes wrong is the run's, not the program's.
  template <typename Work>
  Run guarded(const Work& work) {
    Run run;
    try {
      work(run);
    } catch (const dem::Interrupted&) {
      run.outcome = RunOutcome::not_run;
    } catch (const dem::UnstableRun& error) {
      fail(run, RunOutcome::no_reading, error);
    } catch (const dem::NoReading& error) {
      fail(run, RunOutcome::no_reading, error);
    } catch (const std::invalid_argument& error) {
      fail(run, RunOutcome::bad_input, error);
    } catch (const std::exception& error) {
      fail(run, RunOutcome::internal_error, error);
    }
    return run;
  }

  void fail(Run& run, RunOutcome outcome, const std::exception& error) {
    run.outcome = outcome;
    run.error = error.what();
    has_failed_ = true;
  }

  void simulate(std::size_t index, Run& run) {
    const std::uint64_t seed = plan_.seeds[index];
    const std::string provenance = provenance_json(plan_, seed);
    const std::optional<SavedRestart> saved = saved_restart(plan_, seed);
    std::optional<dem::TrajectoryWriter> trajectory;
    dem::RunRecord record;
    if (plan_.trajectory_s) {
      trajectory.emplace(place_of(plan_, seed), *plan_.trajectory_s, provenance,
                         saved ? saved->film : dem::Film{});
      record.frame_interval_s = *plan_.trajectory_s;
      record.frame = [&](const dem::Simulation& simulation) { trajectory->add(simulation); };
    }
    const Clock::time_point start = Clock::now();
    const auto wall_s = [&] { return (saved ? saved->wall_s : 0) + seconds_since(start); };
    Clock::time_point saved_at = start;
    if (!plan_.out_folder.empty()) {
      record.is_restart_due = [&] { return Clock::now() - saved_at >= kBetweenRestartPoints; };
      record.save_restart = [&](const dem::Simulation& simulation,
                                const dem::HeapProgress& progress) {
        save_restart(plan_, seed, simulation, progress,
                     trajectory ? trajectory->film() : dem::Film{}, wall_s());
        saved_at = Clock::now();
      };
    }
    const auto report = [&](double fraction, const dem::Simulation&) {
      progress_.tell(index, fraction);
      return !is_broken_off();
    };
    run.repeat = experiment(seed, saved, report, record);
    run.wall_s = wall_s();
    if (!plan_.out_folder.empty() && run.repeat.state) {
      run.state_file = place_of(plan_, seed).string() + ".vtp";
      write_state(run.state_file, *run.repeat.state, provenance);
      save_finished(plan_, run);
    }
    if (plan_.views == 0) run.repeat.state.reset();
    run.outcome = RunOutcome::done;
    progress_.tell(index, 1);
  }

  dem::Repeat experiment(std::uint64_t seed, const std::optional<SavedRestart>& saved,
                         const dem::ProgressReport& report, const dem::RunRecord& record) const {
    switch (plan_.experiment) {
      case dem::Experiment::drop:
        return run_drop(model_, *plan_.study.drop, seed, report, record);
      case dem::Experiment::tilt:
        return run_tilt(model_, *plan_.study.tilt, seed, report, record);
      case dem::Experiment::roll:
        return run_roll(model_, *plan_.study.roll, seed, report, record);
      case dem::Experiment::heap:
        break;
    }
    const dem::HeapProtocol& protocol = *plan_.study.heap;
    dem::Repeat heap = saved ? resume_heap(model_, protocol, seed, saved->from, report, record)
                             : run_heap(model_, protocol, seed, report, record);
    calibrate::add_position_angle(heap);
    return heap;
  }

  const SimulatePlan& plan_;
  dem::Model model_;
  const std::atomic<bool>& is_interrupted_;
  std::atomic<bool> has_failed_{false};
  FractionProgress progress_;
};

}  // namespace

std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted) {
  std::vector<Run> runs(plan.seeds.size());
  Batch batch(plan, is_interrupted);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k] = batch.saved(k);
    if (runs[k].outcome == RunOutcome::not_run) open.push_back(k);
  }
  if (batch.is_broken_off() || open.empty()) return runs;
  save_identity(plan);
  const int each = threads_each(plan, open.size());
  batch.set_threads(each);
  tbb::task_arena arena(plan.threads / each);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, open.size(),
                      [&](std::size_t k) { runs[open[k]] = batch.run(open[k]); });
  });
  return runs;
}

}  // namespace repose::cli
