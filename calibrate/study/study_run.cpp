#include "calibrate/study/study_run.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/propose.h"
#include "calibrate/study/job_runner.h"

namespace repose::calibrate {
namespace {

constexpr int kFamilyRepeats = 2;
constexpr int kMaxFits = 3;

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
bool run_rounds(const Problem& problem, JobRunner& runner, std::vector<Run>& runs) {
  for (int round = 1;; ++round) {
    const std::vector<Job> jobs = propose(problem, runs);
    if (jobs.empty()) return true;
    const auto done = runner.get(fmt::format("round {}", round), jobs);
    if (!done) return false;
    runs.insert(runs.end(), done->begin(), done->end());
  }
}

/// Fits, and checks the fit with fresh seeds. A fit that fails was led by curves that are wrong
/// just there: its checks join the runs, and the next fit knows better. False when interrupted.
bool fit_and_check(const Problem& problem, const Budget& budget, JobRunner& runner,
                   StudyOutcome& outcome) {
  for (int attempt = 0; attempt < kMaxFits; ++attempt) {
    outcome.runs.insert(outcome.runs.end(), outcome.checks.begin(), outcome.checks.end());
    outcome.fit = fit_jointly(problem, outcome.runs);
    const std::vector<double> values = values_of(outcome.fit);
    const auto checks = runner.get(
        attempt == 0 ? "checking the result" : fmt::format("checking fit {}", attempt + 1),
        verification_jobs(problem, values, budget.verification_repeats, attempt));
    if (!checks) return false;
    outcome.checks = *checks;
    outcome.best = verify(problem, values, outcome.checks, &outcome.fit);
    if (outcome.best.agrees) break;
  }
  return true;
}

/// Simulates some of the equally good sets. False when interrupted.
bool check_family(const Problem& problem, const Budget& budget, JobRunner& runner,
                  StudyOutcome& outcome) {
  const std::vector<ParameterSet>& family = outcome.fit.equivalence_family;
  const auto count = std::min(family.size(), static_cast<std::size_t>(budget.family_sets));
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < count; ++k) {
    const auto of_set = verification_jobs(problem, family[k].values, kFamilyRepeats,
                                          kMaxFits + static_cast<int>(k));
    jobs.insert(jobs.end(), of_set.begin(), of_set.end());
  }
  const auto checks = runner.get("checking equally good sets", jobs);
  if (!checks) return false;
  for (std::size_t k = 0; k < count; ++k) {
    outcome.family.push_back(verify(problem, family[k].values, *checks, &outcome.fit));
  }
  return true;
}

}  // namespace

std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& budget,
                                      const StudyContext& context) {
  JobRunner runner(problem, context);
  StudyOutcome outcome;
  try {
    const FitWatch watch(context.is_interrupted);
    if (!run_rounds(problem, runner, outcome.runs)) return std::nullopt;
    if (!fit_and_check(problem, budget, runner, outcome)) return std::nullopt;
    if (!check_family(problem, budget, runner, outcome)) return std::nullopt;
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  note_missing_grains(outcome.notes, outcome.runs);
  outcome.simulated = runner.simulated();
  outcome.reused = runner.reused();
  return outcome;
}

}  // namespace repose::calibrate
