#include "cli/simulate_runs.h"

#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/simulate_json.h"
#include "cli/simulate_names.h"
#include "cli/simulate_progress.h"
#include "dem/engine/unstable_run.h"
#include "dem/state/state_file.h"
#include "dem/state/trajectory.h"

namespace repose::cli {
namespace {

dem::Repeat run_experiment(const SimulatePlan& plan, std::uint64_t seed,
                           const dem::ProgressReport& report) {
  switch (plan.experiment) {
    case dem::Experiment::drop:
      return run_drop(plan.bench, *plan.study.drop, seed, report);
    case dem::Experiment::tilt:
      return run_tilt(plan.bench, *plan.study.tilt, seed, report);
    case dem::Experiment::roll:
      return run_roll(plan.bench, *plan.study.roll, seed, report);
    case dem::Experiment::heap:
      break;
  }
  return run_heap(plan.bench, *plan.study.heap, seed, report);
}

/// "heap_seed_3": what a repeat's files are called.
std::filesystem::path place_of(const SimulatePlan& plan, std::uint64_t seed) {
  return plan.out_folder / fmt::format("{}_seed_{}", names_of(plan.experiment).name, seed);
}

class Batch {
 public:
  Batch(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted)
      : plan_(plan), is_interrupted_(is_interrupted), progress_(plan.seeds.size()) {}

  Run run(std::size_t index) {
    Run run;
    if (is_broken_off()) return run;
    try {
      simulate(index, run);
    } catch (const dem::Interrupted&) {
      run.outcome = RunOutcome::not_run;
    } catch (const dem::UnstableRun& fault) {
      fail(run, RunOutcome::no_reading, fault);
    } catch (const dem::NoReading& fault) {
      fail(run, RunOutcome::no_reading, fault);
    } catch (const std::invalid_argument& fault) {
      fail(run, RunOutcome::bad_input, fault);
    } catch (const std::exception& error) {
      fail(run, RunOutcome::internal_error, error);
    }
    return run;
  }

 private:
  bool is_broken_off() const { return is_interrupted_ || has_failed_; }

  void fail(Run& run, RunOutcome outcome, const std::exception& fault) {
    run.outcome = outcome;
    run.fault = fault.what();
    has_failed_ = true;
  }

  void simulate(std::size_t index, Run& run) {
    const std::uint64_t seed = plan_.seeds[index];
    const std::string provenance = provenance_json(plan_, seed);
    std::optional<dem::TrajectoryWriter> trajectory;
    if (plan_.trajectory_s) {
      trajectory.emplace(place_of(plan_, seed), *plan_.trajectory_s, provenance);
    }
    const auto start = std::chrono::steady_clock::now();
    run.repeat = run_experiment(plan_, seed, [&](double share, const dem::Simulation& simulation) {
      progress_.tell(index, share);
      if (trajectory) trajectory->offer(simulation);
      return !is_broken_off();
    });
    run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!plan_.out_folder.empty() && run.repeat.state) {
      run.state_file = place_of(plan_, seed).string() + ".vtp";
      write_state(run.state_file, *run.repeat.state, provenance);
    }
    run.repeat.state.reset();
    run.outcome = RunOutcome::done;
    progress_.tell(index, 1);
  }

  const SimulatePlan& plan_;
  const std::atomic<bool>& is_interrupted_;
  std::atomic<bool> has_failed_{false};
  ShareProgress progress_;
};

}  // namespace

std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted) {
  std::vector<Run> runs(plan.seeds.size());
  Batch batch(plan, is_interrupted);
  if (runs.size() == 1) {
    runs.front() = batch.run(0);
    return runs;
  }
  tbb::task_arena arena(plan.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, runs.size(),
                      [&](std::size_t index) { runs[index] = batch.run(index); });
  });
  return runs;
}

std::optional<vision::Repeats> summarise(const std::vector<Run>& runs) {
  std::vector<double> values;
  for (const Run& run : runs) {
    if (run.outcome == RunOutcome::done && std::isfinite(run.repeat.value)) {
      values.push_back(run.repeat.value);
    }
  }
  if (values.empty() || values.size() != runs.size()) return std::nullopt;
  return vision::summarise(values);
}

}  // namespace repose::cli
