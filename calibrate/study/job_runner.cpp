#include "calibrate/study/job_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "calibrate/fit/points.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {
namespace {

/// Error in the readings of a run, whoever made it; empty: they are possible.
std::string fault_of(const RunSpec& spec, const Run& run) {
  if (!run.failure.empty()) return {};
  const dem::ExperimentEntry& entry = spec.entry();
  const double value = run.readings.at("value");
  const dem::Range possible = entry.possible(spec.model, spec.protocol);
  if (!possible.contains(value)) {
    return fmt::format("its {} is {:.4g} {}. Rule: {}", entry.value_name, value, entry.unit,
                       possible.rule());
  }
  for (const auto& [name, reading] : run.readings) {
    if (std::abs(reading) <= kMaxReading) continue;
    return fmt::format("its {} is {:.4g}. Rule: at most {:g}", name, reading, kMaxReading);
  }
  return {};
}

}  // namespace

double run_s_of(const Problem& problem, const Job& job) {
  for (const Experiment& experiment : problem.experiments) {
    if (experiment.name == job.experiment) return run_s_of(experiment, job.inputs);
  }
  return 0;
}

std::optional<std::vector<Run>> JobRunner::get(const std::string& stage,
                                               const std::vector<Job>& jobs,
                                               std::optional<double> later_s) {
  stage_ = stage;
  std::vector<std::optional<Run>> runs(jobs.size());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    auto saved = context_.folder.find_whole(context_.simulator.spec(jobs[k]), jobs[k].seed);
    if (saved) runs[k] = possible(jobs[k], *std::move(saved));
    if (!runs[k]) open.push_back(k);
  }
  reused_ += static_cast<int>(jobs.size() - open.size());
  std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
    return run_s_of(problem_, jobs[a]) > run_s_of(problem_, jobs[b]);
  });
  simulate({.stage = stage,
            .of = static_cast<int>(open.size()),
            .seconds_later = later_s,
            .rounds = rounds_},
           jobs, open, runs);
  if (context_.is_interrupted) return std::nullopt;
  std::vector<Run> done;
  done.reserve(runs.size());
  for (std::optional<Run>& run : runs) done.push_back(std::move(run.value()));
  return done;
}

void JobRunner::simulate(StudyProgress progress, const std::vector<Job>& jobs,
                         const std::vector<std::size_t>& open,
                         std::vector<std::optional<Run>>& runs) {
  std::vector<Job> missing;
  for (const std::size_t k : open) {
    missing.push_back(jobs[k]);
    progress.seconds_of += run_s_of(problem_, jobs[k]);
  }
  if (missing.empty()) return;
  context_.report(progress);
  context_.executor.run(
      missing,
      [&](std::size_t k, const RunResult& result) {
        keep(missing[k], result);
        runs[open[k]] = possible(missing[k], result);
        ++simulated_;
        ++progress.done;
        progress.seconds_done += run_s_of(problem_, missing[k]);
        context_.report(progress);
      },
      context_.is_interrupted);
}

/// Whoever simulates saves its runs, unless its folder is on another machine.
void JobRunner::keep(const Job& job, const RunResult& result) const {
  const RunSpec spec = context_.simulator.spec(job);
  if (!context_.folder.find_whole(spec, job.seed)) context_.folder.save(spec, result);
}

Run JobRunner::possible(const Job& job, RunResult result) const {
  const RunSpec spec = context_.simulator.spec(job);
  result.definition = spec.definition;  // another process does not send it
  Run run = run_of(job, result);
  std::string fault = fault_of(spec, run);
  if (fault.empty()) return run;
  context_.folder.note(
      fmt::format("{} with seed {}: {}. It counts as a run that failed. Fix: check the materials "
                  "and the protocol of the study; its file is {}",
                  run.job.experiment, run.job.seed, fault,
                  (context_.folder.runs() / (key_of(spec, run.job.seed) + ".json")).string()));
  run.readings.clear();
  run.failure = std::move(fault);
  return run;
}

NamedAngles heap_angles_deg(const StudyContext& context, const std::vector<Run>& runs) {
  std::vector<RunResult> heaps;
  for (const Run& run : runs) {
    if (!run.failure.empty()) continue;
    auto saved = context.folder.find(context.simulator.spec(run.job), run.job.seed);
    if (saved && !values_by_definition(*saved).empty()) heaps.push_back(*std::move(saved));
  }
  return means_by_definition(heaps);
}

}  // namespace repose::calibrate
