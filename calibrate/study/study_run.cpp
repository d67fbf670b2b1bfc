#include "calibrate/study/study_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/distributions.h"
#include "calibrate/fit/first_round.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/profile.h"
#include "calibrate/fit/propose.h"
#include "calibrate/fit/unit_box.h"
#include "calibrate/study/job_runner.h"
#include "calibrate/study/study_estimate.h"

namespace repose::calibrate {
namespace {

constexpr double kNear = .5;  // of the uncertainty of measurement: a step that hardly matters

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
bool run_rounds(const Problem& problem, const Budget& budget, JobRunner& runner,
                std::vector<Run>& runs) {
  const int most = problem.settings.max_rounds + (has_followers(problem) ? 1 : 0);
  double left_s = 0, checks_s = 0;
  for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
    left_s += estimate.fit_runs * estimate.run_s;
    checks_s += estimate.check_runs * estimate.run_s;
    checks_s += estimate.stiff_runs * estimate.stiff_run_s;
  }
  for (int round = 1;; ++round) {
    const std::vector<Job> jobs = propose(problem, runs);
    if (jobs.empty()) return true;
    for (const Job& job : jobs) left_s -= run_s_of(problem, job);
    const double later_s = checks_s + (round < most ? std::max(0., left_s) : 0);
    const auto done = runner.get(fmt::format("round {} of at most {}", round, most), jobs, later_s);
    if (!done) return false;
    runs.insert(runs.end(), done->begin(), done->end());
  }
}

std::vector<Run> joined(std::vector<Run> runs, const std::vector<Run>& more) {
  runs.insert(runs.end(), more.begin(), more.end());
  return runs;
}

/// Simulates some of the sets that fit as well as the best, for what the surrogates do not know:
/// the fit that follows has learned from them. False when interrupted.
bool try_family(const Problem& problem, const Budget& budget, JobRunner& runner,
                std::vector<std::vector<double>>& tried, StudyOutcome& outcome) {
  if (budget.family_sets < 1) return true;
  const std::vector<ParameterSet> family = fit_jointly(problem, outcome.runs).equivalence_family;
  std::vector<Job> jobs;
  for (const ParameterSet& set : family) {
    if (tried.size() >= static_cast<std::size_t>(budget.family_sets)) break;
    const int number = kMostCheckRounds + static_cast<int>(tried.size());
    const auto of_set = verification_jobs(problem, set.values, kFamilyRepeats, number);
    jobs.insert(jobs.end(), of_set.begin(), of_set.end());
    tried.push_back(set.values);
  }
  const auto checks = runner.get("checking equally good sets", jobs,
                                 kMostCheckRounds * check_s(problem, budget.verification_repeats) +
                                     last_runs_s(problem, budget.verification_repeats));
  if (!checks) return false;
  outcome.runs = joined(std::move(outcome.runs), *checks);
  return true;
}

/// The readings at the fitted coefficients are those at the ones checked, as far as it matters.
bool is_near(const JointFit& fit, const PredictedSet& checked) {
  for (std::size_t i = 0; i < fit.observables.size(); ++i) {
    const FittedObservable& fitted = fit.observables[i];
    const double step = std::abs(fitted.simulated - checked.simulated[i]);
    if (step > kNear * fitted.measured_uncertainty) return false;
  }
  return true;
}

/// Simulates the fit with fresh seeds and fits again with these runs, until that changes nothing
/// any more or there were enough rounds. Whether bench and simulation agree plays no part in it:
/// a fit is not chosen because it does. False when interrupted.
bool fit_and_check(const Problem& problem, const Budget& budget, JobRunner& runner,
                   const std::vector<std::vector<double>>& tried, StudyOutcome& outcome) {
  outcome.fit = fit_jointly(problem, outcome.runs);
  bool is_settled = false;
  while (!is_settled && outcome.check_rounds < kMostCheckRounds) {
    const std::vector<double> values = values_of(outcome.fit);
    const auto checks = runner.get(
        fmt::format("check {} of at most {}", outcome.check_rounds + 1, kMostCheckRounds),
        verification_jobs(problem, values, budget.verification_repeats, outcome.check_rounds),
        (kMostCheckRounds - outcome.check_rounds - 1) *
                check_s(problem, budget.verification_repeats) +
            last_runs_s(problem, budget.verification_repeats));
    if (!checks) return false;
    ++outcome.check_rounds;
    outcome.checks = *checks;
    outcome.surrogates = check_surrogates(problem, outcome.fit, *checks);
    outcome.runs = joined(std::move(outcome.runs), *checks);
    std::vector<std::vector<double>> asked = {values};
    asked.insert(asked.end(), tried.begin(), tried.end());
    outcome.fit = fit_jointly(problem, outcome.runs, asked);
    outcome.best = verify(problem, values, *checks, &outcome.fit);
    is_settled = is_near(outcome.fit, outcome.fit.asked.front());
  }
  return true;
}

/// Those of the sets that were simulated and that the fit still takes for as good as the best: with
/// what their own simulations say.
void judge_family(const Problem& problem, StudyOutcome& outcome) {
  int ruled_out = 0;
  for (std::size_t k = 1; k < outcome.fit.asked.size(); ++k) {
    const PredictedSet& set = outcome.fit.asked[k];
    if (set.chi2 > kChi2Limit) {
      ++ruled_out;
      continue;
    }
    const Verification check = verify(problem, set.values, outcome.runs, &outcome.fit);
    if (check.verdict == AgreementVerdict::disagrees) ++ruled_out;
    outcome.family.push_back({check, set.chi2});
  }
  if (ruled_out == 0) return;
  outcome.notes.push_back(
      fmt::format("{} of {} sets that had seemed to fit as well as the best were simulated and are "
                  "ruled out now",
                  ruled_out, outcome.fit.asked.size() - 1));
}

/// Simulates what was held out at coefficients drawn from the fit. False when interrupted.
bool predict(const Problem& problem, JobRunner& runner, StudyOutcome& outcome) {
  const std::vector<Job> jobs = prediction_jobs(problem, outcome.fit);
  if (jobs.empty()) return true;
  const auto runs = runner.get("predicting what is held out", jobs, 0);
  if (!runs) return false;
  outcome.predictions = predictions_of(problem, outcome.fit, *runs);
  return true;
}

/// Simulates softened experiments with stiffer grains at the coefficients that were checked last.
/// False when interrupted.
bool stiffen(const Problem& problem, const Budget& budget, JobRunner& runner,
             StudyOutcome& outcome) {
  const StiffnessPlan plan =
      plan_stiffness(problem, outcome.best.values, budget.verification_repeats);
  const bool is_largest = budget.settings.budget_s >= budget_named("standard").settings.budget_s;
  for (const std::string& experiment : plan.too_dear) {
    outcome.notes.push_back(fmt::format(
        "{}: it is not known what its stiffness_factor does to its readings: stiffer grains would "
        "take more than a fifth of this budget. Fix: {}.",
        experiment,
        is_largest ? "simulate it at these coefficients with a larger stiffness_factor"
                   : "the budget standard"));
  }
  if (plan.jobs.empty()) return true;
  const auto runs = runner.get("simulating stiffer grains", plan.jobs, 0);
  if (!runs) return false;
  outcome.stiffness =
      check_stiffness(problem, outcome.best.values, joined(outcome.runs, *runs), outcome.fit);
  outcome.stiffer = stiffer_coefficients(problem, outcome.stiffness, outcome.runs);
  return true;
}

/// Readings that are not those of real grains.
void note_stiffness(StudyOutcome& outcome) {
  for (const StiffnessCheck& check : outcome.stiffness) {
    if (check.verdict != AgreementVerdict::disagrees) continue;
    if (check.runs == 0) {
      outcome.notes.push_back(fmt::format(
          "{}: with a stiffness_factor of {:.3g} no run has this reading, and the study's softer "
          "grains do. Fix: stiffness_factor = {:.3g}, and calibrate again.",
          check.name, check.stiffness_factor, check.stiffness_factor));
      continue;
    }
    outcome.notes.push_back(fmt::format(
        "{}: the study's grains are too soft for this reading, and the coefficients make up for "
        "it: "
        "with a stiffness_factor of {:.3g} it changes by {:+.3g} {} (95 %: {:.3g} to {:.3g}), and "
        "the bench's mean is known within {:.2g}. Fix: stiffness_factor = {:.3g}, and calibrate "
        "again.",
        check.name, check.stiffness_factor, check.change, check.unit, check.interval.low,
        check.interval.high, check.limit, check.stiffness_factor));
  }
}

void note_checks(const Problem& problem, StudyOutcome& outcome) {
  for (const SurrogateCheck& check : outcome.surrogates) {
    if (!check.misses) continue;
    outcome.notes.push_back(fmt::format(
        "{}: the surrogate missed its own check: it expected {:.4g} ± {:.2g} (95 %) and fresh runs "
        "gave "
        "{:.4g}, by chance in {:.2g} % of cases only. These runs are in the fit now; a larger "
        "budget "
        "would show how well it knows the rest.",
        check.observable, check.predicted, base::kNormal95 * check.uncertainty, check.simulated,
        100 * check.chance));
  }
  const PredictedSet& checked = outcome.fit.asked.front();
  if (is_near(outcome.fit, checked)) return;
  std::string moved;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const FittedObservable& fitted = outcome.fit.observables[i];
    moved += fmt::format("{}{} {:+.3g} {}", moved.empty() ? "" : ", ", fitted.name,
                         fitted.simulated - checked.simulated[i], fitted.unit);
  }
  outcome.notes.push_back(fmt::format(
      "after {} rounds of checks the coefficients still change: according to the surrogates, those "
      "reported differ from those checked last by: {}. A larger budget would settle them.",
      outcome.check_rounds, moved));
}

}  // namespace

std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& budget,
                                      const StudyContext& context) {
  JobRunner runner(problem, context);
  StudyOutcome outcome;
  std::vector<std::vector<double>> tried;
  try {
    const FitWatch watch(context.is_interrupted);
    if (!run_rounds(problem, budget, runner, outcome.runs)) return std::nullopt;
    if (!try_family(problem, budget, runner, tried, outcome)) return std::nullopt;
    if (!fit_and_check(problem, budget, runner, tried, outcome)) return std::nullopt;
    judge_family(problem, outcome);
    if (!predict(problem, runner, outcome)) return std::nullopt;
    if (!stiffen(problem, budget, runner, outcome)) return std::nullopt;
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  note_checks(problem, outcome);
  note_stiffness(outcome);
  note_missing_grains(outcome.notes, outcome.runs);
  outcome.simulated = runner.simulated();
  outcome.reused = runner.reused();
  return outcome;
}

}  // namespace repose::calibrate
