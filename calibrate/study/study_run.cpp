#include "calibrate/study/study_run.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "calibrate/fit/propose.h"

namespace repose::calibrate {
namespace {

constexpr int kFamilyRepeats = 2;

std::vector<double> values_of(const JointFit& fit) {
  std::vector<double> values;
  for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  return values;
}

/// Heaps of fewer grains than the study asks for, since no more fit into the tube.
void note_missing_grains(std::vector<std::string>& notes, const std::vector<Run>& runs) {
  double most = 0, least = std::numeric_limits<double>::infinity();
  for (const Run& run : runs) {
    const auto grains = run.readings.find("grains");
    if (run.job.experiment != "heap" || grains == run.readings.end()) continue;
    most = std::max(most, grains->second);
    least = std::min(least, grains->second);
  }
  if (least >= most) return;
  notes.push_back(fmt::format(
      "heap: with much friction not all grains fit into the tube: heaps are of {:.0f} to {:.0f} "
      "grains. If your tube took them all, narrow the bounds of friction.",
      least, most));
}

/// Rounds until the fit has settled; false when interrupted.
bool run_rounds(const Problem& problem, Workshop& workshop, std::vector<Run>& runs) {
  for (int round = 1;; ++round) {
    const std::vector<Job> jobs = propose(problem, runs);
    if (jobs.empty()) return true;
    const auto done = workshop.get(fmt::format("round {}", round), jobs);
    if (!done) return false;
    runs.insert(runs.end(), done->begin(), done->end());
  }
}

}  // namespace

std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& budget,
                                      const StudyBench& bench, const RunFolder& folder,
                                      Executor& executor, const StudyReport& report,
                                      const std::atomic<bool>& is_interrupted) {
  Workshop workshop(problem, bench, folder, executor, report, is_interrupted);
  StudyOutcome outcome;
  if (!run_rounds(problem, workshop, outcome.runs)) return std::nullopt;
  outcome.fit = fit_jointly(problem, outcome.runs);
  note_missing_grains(outcome.notes, outcome.runs);

  std::vector<std::vector<double>> sets = {values_of(outcome.fit)};
  const std::vector<ParameterSet>& family = outcome.fit.equivalence_family;
  const auto checked = std::min(family.size(), static_cast<std::size_t>(budget.family_sets));
  for (std::size_t k = 0; k < checked; ++k) sets.push_back(family[k].values);
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const int repeats = k == 0 ? budget.verification_repeats : kFamilyRepeats;
    const std::vector<Job> of_set =
        verification_jobs(problem, sets[k], repeats, static_cast<int>(k));
    jobs.insert(jobs.end(), of_set.begin(), of_set.end());
  }
  const auto checks = workshop.get("checking the result", jobs);
  if (!checks) return std::nullopt;
  outcome.best = verify(problem, sets.front(), *checks, &outcome.fit);
  for (std::size_t k = 1; k < sets.size(); ++k) {
    outcome.family.push_back(verify(problem, sets[k], *checks, &outcome.fit));
  }
  outcome.checks = *checks;
  outcome.simulated = workshop.simulated();
  outcome.reused = workshop.reused();
  return outcome;
}

}  // namespace repose::calibrate
