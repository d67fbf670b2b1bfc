#include "cli/simulate/simulate_runs.h"

#include <algorithm>
#include <exception>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/input_error.h"
#include "calibrate/experiment/draw_down_front.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "cli/simulate/simulate_folder.h"
#include "cli/simulate/simulate_progress.h"
#include "dem/state/state_file.h"

namespace repose::cli {
namespace {

/// Threads that work on one repeat: those that are left over when each has one. What is finished
/// already needs none.
int threads_each(const SimulatePlan& plan, const std::optional<calibrate::RunFolder>& folder) {
  const auto open = std::count_if(plan.seeds.begin(), plan.seeds.end(), [&](std::uint64_t seed) {
    return !folder || !folder->find(plan.spec, seed);
  });
  return std::max(1, plan.threads / std::max(1, static_cast<int>(open)));
}

/// A heap's first view with what was measured drawn in.
void draw_overlay(const Run& run, const calibrate::HeapViewing& viewing) {
  const calibrate::HeapViewSession session(render::scene_of(dem::read_state(run.state_file)),
                                           viewing);
  render::Renderer renderer;
  session.measure(renderer, 0, run.overlay_file);
}

/// The front of a draw-down with the slopes that were measured drawn in.
void draw_front(const Run& run, const dem::DrawDownProtocol& boxes) {
  const calibrate::DrawDownFront front =
      calibrate::draw_down_front(render::scene_of(dem::read_state(run.state_file)), boxes);
  const std::string title = std::filesystem::path(run.overlay_file).filename().string();
  vision::write_picture(run.overlay_file,
                        vision::draw_slopes_overlay(front.picture, front.slopes, title));
}

class Batch {
 public:
  Batch(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted)
      : plan_(plan),
        spec_(plan.spec),
        is_interrupted_(is_interrupted),
        progress_(plan.seeds.size()) {
    if (!plan.out_folder.empty()) folder_.emplace(plan.out_folder);
    spec_.model.threads = threads_each(plan, folder_);
  }

  int runs_at_once() const { return plan_.threads / spec_.model.threads; }

  /// Whatever goes wrong is the run's, not the program's.
  Run run(std::size_t index) {
    Run run;
    if (is_stopping()) return run;
    try {
      simulate(index, run);
    } catch (const dem::Interrupted&) {
      run.outcome = RunOutcome::not_run;
    } catch (const base::InputError& error) {
      fail(run, RunOutcome::bad_input, error.what());
    } catch (const std::exception& error) {
      fail(run, RunOutcome::internal_error, error.what());
    }
    return run;
  }

 private:
  bool is_stopping() const { return is_interrupted_ || has_failed_; }

  void fail(Run& run, RunOutcome outcome, const std::string& error) {
    run.outcome = outcome;
    run.error = error;
    has_failed_ = true;
  }

  void simulate(std::size_t index, Run& run) {
    const std::uint64_t seed = plan_.seeds[index];
    const std::string place = place_of(plan_, seed).string();
    calibrate::SimulateOptions options;
    options.saves_state = true;
    if (folder_) options.folder = &*folder_;
    if (plan_.trajectory_s) options.trajectory = {place, *plan_.trajectory_s};
    options.report = [&](double fraction) {
      progress_.report(index, fraction);
      return !is_stopping();
    };
    run.result = simulate_experiment(spec_, seed, options);
    if (!run.result.failure.empty()) {
      run.outcome = RunOutcome::no_reading;
      run.error = run.result.failure;
      progress_.report(index, 1);
      if (folder_) name_state(run, place);
      return;
    }
    run.outcome = RunOutcome::done;
    progress_.report(index, 1);
    if (folder_) name_files(run, place);
  }

  /// Puts the final state beside the store, where the seed tells whose it is; false without one.
  bool name_state(Run& run, const std::string& place) {
    const std::string state = place + ".vtp";
    const auto name = std::filesystem::path(state).filename().string();
    if (!folder_->copy_state(spec_, run.result.seed, name)) return false;
    run.state_file = state;
    return true;
  }

  /// The same, with a picture of it.
  void name_files(Run& run, const std::string& place) {
    if (!name_state(run, place)) {
      throw base::InputError({.where = fmt::format("{}", place + ".vtp"),
                              .value = fmt::format("its run in {} was changed in the meantime",
                                                   folder_->runs().string()),
                              .fix = "run the same command again."});
    }
    const auto* boxes = std::get_if<dem::DrawDownProtocol>(&spec_.protocol);
    if (run.result.views.empty() && boxes == nullptr) return;
    run.overlay_file = place + ".overlay.png";
    boxes != nullptr ? draw_front(run, *boxes) : draw_overlay(run, spec_.viewing);
  }

  const SimulatePlan& plan_;
  calibrate::RunSpec spec_;
  const std::atomic<bool>& is_interrupted_;
  std::optional<calibrate::RunFolder> folder_;
  std::atomic<bool> has_failed_{false};
  RepeatsProgress progress_;
};

}  // namespace

std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted) {
  std::vector<Run> runs(plan.seeds.size());
  save_identity(plan);
  Batch batch(plan, is_interrupted);
  tbb::task_arena arena(batch.runs_at_once());
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) { runs[k] = batch.run(k); });
  });
  return runs;
}

}  // namespace repose::cli
