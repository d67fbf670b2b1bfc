#include "calibrate/study/job_runner.h"

#include <algorithm>
#include <utility>

namespace repose::calibrate {

std::optional<std::vector<Run>> JobRunner::get(const std::string& stage,
                                               const std::vector<Job>& jobs) {
  std::vector<std::optional<Run>> runs(jobs.size());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    auto saved = context_.folder.find_whole(context_.simulator.spec(jobs[k]), jobs[k].seed);
    if (saved) runs[k] = run_of({.job = jobs[k], .run = *std::move(saved)});
    if (!runs[k]) open.push_back(k);
  }
  reused_ += static_cast<int>(jobs.size() - open.size());
  std::stable_sort(open.begin(), open.end(),
                   [&](std::size_t a, std::size_t b) { return cost_s(jobs[a]) > cost_s(jobs[b]); });
  simulate(stage, jobs, open, runs);
  if (context_.is_interrupted) return std::nullopt;
  std::vector<Run> done;
  done.reserve(runs.size());
  for (std::optional<Run>& run : runs) done.push_back(std::move(run.value()));
  return done;
}

void JobRunner::simulate(const std::string& stage, const std::vector<Job>& jobs,
                         const std::vector<std::size_t>& open,
                         std::vector<std::optional<Run>>& runs) {
  std::vector<Job> missing;
  StudyProgress progress{.stage = stage, .done = 0, .of = static_cast<int>(open.size())};
  for (const std::size_t k : open) {
    missing.push_back(jobs[k]);
    progress.seconds_of += cost_s(jobs[k]);
  }
  if (missing.empty()) return;
  context_.report(progress);
  context_.executor.run(
      missing,
      [&](std::size_t k, const SimulatedJob& done) {
        keep(done);
        runs[open[k]] = run_of(done);
        ++simulated_;
        ++progress.done;
        progress.seconds_done += cost_s(missing[k]);
        context_.report(progress);
      },
      context_.is_interrupted);
}

/// Whoever simulates saves its runs, but where its folder is another machine's.
void JobRunner::keep(const SimulatedJob& done) const {
  const RunSpec spec = context_.simulator.spec(done.job);
  if (!context_.folder.find_whole(spec, done.job.seed)) context_.folder.save(spec, done.run);
}

double JobRunner::cost_s(const Job& job) const {
  for (const Experiment& experiment : problem_.experiments) {
    if (experiment.name == job.experiment) return experiment.run_s;
  }
  return 0;
}

}  // namespace repose::calibrate
