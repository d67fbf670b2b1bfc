#include "calibrate/study/study_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/fit/solution.h"
#include "calibrate/study/job_runner.h"
#include "calibrate/study/study_estimate.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {
namespace {

constexpr double kNear = .5;  // of the measurement uncertainty: a smaller step hardly matters

std::vector<double> values_of(const JointFit& fit) {
  std::vector<double> values;
  for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  return values;
}

/// Heaps of fewer grains than the study requests, because no more fit into the tube.
void note_missing_grains(std::vector<std::string>& notes, const std::vector<Run>& runs) {
  double most = 0, least = std::numeric_limits<double>::infinity();
  for (const Run& run : runs) {
    const auto grains = run.readings.find("grains");
    const bool may_be_fewer = dem::experiment_named(run.job.experiment).grains_asked != nullptr;
    if (!may_be_fewer || grains == run.readings.end() || run.job.inputs.size != 1) continue;
    most = std::max(most, grains->second);
    least = std::min(least, grains->second);
  }
  if (least >= most) return;
  notes.push_back(fmt::format(
      "heap: with much friction not all grains fit into the tube: heaps are of {:.0f} to {:.0f} "
      "grains. If your tube took them all, narrow the bounds of friction.",
      least, most));
}

/// Makes rounds until the fit has settled; false if interrupted.
bool run_rounds(const Problem& problem, const Budget& budget, JobRunner& runner,
                std::vector<Run>& runs) {
  require_sound(problem);
  const int most = problem.settings.max_rounds + (has_followers(problem) ? 1 : 0);
  double left_s = 0, checks_s = 0;
  for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
    const double fit_s =
        estimate.of(Phase::first_round).seconds + estimate.of(Phase::later_rounds).seconds;
    left_s += fit_s;
    checks_s += estimate.all().seconds - fit_s;
  }
  for (int round = 1;; ++round) {
    const auto [complete, jobs] = reconstruct_rounds(problem, runs);
    runner.tell(complete);
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

/// Simulates some of the sets that fit as well as the best, to cover what the surrogates do not
/// know: the fit that follows has learned from them. False if interrupted.
bool simulate_equivalent_sets(const Problem& problem, const Budget& budget, JobRunner& runner,
                              std::vector<std::vector<double>>& tried, StudyOutcome& outcome) {
  if (budget.family_sets < 1) return true;
  const std::vector<ParameterSet> family = fit_jointly(problem, outcome.runs).equivalence_family;
  std::vector<Job> jobs;
  for (const ParameterSet& set : family) {
    if (tried.size() >= static_cast<std::size_t>(budget.family_sets)) break;
    const int number = kMaxCheckRounds + static_cast<int>(tried.size());
    const auto of_set = verification_jobs(problem, set.values, kFamilyRepeats, number);
    jobs.insert(jobs.end(), of_set.begin(), of_set.end());
    tried.push_back(set.values);
  }
  const auto checks = runner.get("checking equally good sets", jobs,
                                 checks_s(problem, budget, budget.check_rounds) +
                                     last_runs_s(problem, budget.verification_repeats));
  if (!checks) return false;
  outcome.runs = joined(std::move(outcome.runs), *checks);
  return true;
}

/// Whether the readings at the fitted coefficients match those at the checked ones closely enough.
bool is_near(const JointFit& fit, const PredictedSet& checked) {
  for (std::size_t i = 0; i < fit.observables.size(); ++i) {
    const FittedObservable& fitted = fit.observables[i];
    const double step = std::abs(fitted.simulated - checked.simulated[i]);
    if (step > kNear * fitted.measured_uncertainty) return false;
  }
  return true;
}

/// One set of coefficients, checked, with as many runs as requested at any time.
class Check {
 public:
  Check(const Problem& problem, StudyOutcome& outcome)
      : problem_(problem),
        outcome_(outcome),
        before_(outcome.fit),
        values_(values_of(outcome.fit)),
        set_(outcome.check_rounds++) {
    outcome_.checks.clear();
  }

  /// Jobs of `repeats` repeats that were not simulated yet.
  std::vector<Job> jobs(int repeats) const {
    std::vector<Job> jobs = verification_jobs(problem_, values_, repeats, set_);
    std::erase_if(jobs, [&](const Job& job) {
      return std::ranges::find(outcome_.checks, job, &Run::job) != outcome_.checks.end();
    });
    return jobs;
  }

  /// Refits with these runs. Returns whether that hardly changes anything.
  bool add(const std::vector<Run>& runs, const std::vector<std::vector<double>>& tried) {
    outcome_.checks = joined(std::move(outcome_.checks), runs);
    outcome_.runs = joined(std::move(outcome_.runs), runs);
    outcome_.surrogates = check_surrogates(problem_, before_, outcome_.checks);
    std::vector<std::vector<double>> asked = {values_};
    asked.insert(asked.end(), tried.begin(), tried.end());
    outcome_.fit = fit_jointly(problem_, outcome_.runs, asked);
    outcome_.best = verify(problem_, values_, outcome_.checks, &outcome_.fit, &before_.freedom);
    return is_near(outcome_.fit, outcome_.fit.asked.front());
  }

 private:
  const Problem& problem_;
  StudyOutcome& outcome_;
  const JointFit before_;
  const std::vector<double> values_;
  const int set_;
};

/// Simulates the fit with a few fresh seeds and refits with these runs, until that changes nothing
/// any more or there were enough rounds; the last of these checks is a large one. Whether bench and
/// simulation agree plays no part in it: a fit is not chosen because it does. False if interrupted.
bool fit_and_check(const Problem& problem, const Budget& budget, JobRunner& runner,
                   const std::vector<std::vector<double>>& tried, StudyOutcome& outcome) {
  const double last_s = last_runs_s(problem, budget.verification_repeats);
  outcome.fit = fit_jointly(problem, outcome.runs);
  for (;;) {
    Check check(problem, outcome);
    const int rounds_left = budget.check_rounds - outcome.check_rounds;
    const bool is_last = rounds_left == 0;
    const auto first =
        runner.get(fmt::format("check {} of at most {}", outcome.check_rounds, budget.check_rounds),
                   check.jobs(is_last ? budget.verification_repeats : budget.round_repeats),
                   last_s + (is_last ? 0 : checks_s(problem, budget, rounds_left)));
    if (!first) return false;
    const bool is_settled = check.add(*first, tried);
    if (is_last) return true;
    if (!is_settled) continue;
    const auto rest = runner.get("last check", check.jobs(budget.verification_repeats), last_s);
    if (!rest) return false;
    check.add(*rest, tried);
    return true;
  }
}

/// Keeps the simulated sets that the fit still considers as good as the best, with the results of
/// their own simulations.
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

/// Simulates what was held out at coefficients drawn from the fit. False if interrupted.
bool predict(const Problem& problem, JobRunner& runner, StudyOutcome& outcome) {
  const std::vector<Job> jobs = prediction_jobs(problem, outcome.fit);
  if (jobs.empty()) return true;
  const auto runs = runner.get("predicting what is held out", jobs, 0);
  if (!runs) return false;
  outcome.predictions = predictions_of(problem, outcome.fit, *runs);
  return true;
}

/// Names of a check of an assumed input, and what to do if it shows that the input matters.
struct InputWords {
  std::string stage;
  std::string matters;      ///< "the study's grains are too soft for this reading"
  std::string other;        ///< "with a stiffness_factor of 0.1"
  std::string fix;          ///< if a reading changes
  std::string over_budget;  ///< what is not known, and why
  std::string by_hand;      ///< what to do about that if no budget is larger
};

/// `value`: of the simulated input.
InputWords words_of(AssumedInput input, const Problem& problem, double value) {
  if (input == AssumedInput::stiffness) {
    return {.stage = "simulating stiffer grains",
            .matters = "the study's grains are too soft for this reading",
            .other = fmt::format("with a stiffness_factor of {:.3g}", value),
            .fix = fmt::format("stiffness_factor = {:.3g}, and calibrate again", value),
            .over_budget = "what its stiffness_factor does to its readings: stiffer grains",
            .by_hand = "simulate it at these coefficients with a larger stiffness_factor"};
  }
  const int study = problem.spheres.count;
  return {
      .stage = "simulating grains of more spheres",
      .matters = fmt::format("this reading depends on the number of spheres, and the "
                             "coefficients are good only with this clump of {}",
                             study),
      .other = fmt::format("with {:.0f} spheres", value),
      .fix = fmt::format("{}spheres = {:.0f}, and calibrate again",
                         problem.spheres.share_damping
                             ? ""
                             : "damping = \"shared\" in [contact], with which impacts depend less "
                               "on the spheres that touch; or ",
                         value),
      .over_budget = "what its number of spheres does to its readings: grains of more",
      .by_hand = "simulate it at these coefficients with more spheres"};
}

/// Experiments with other values of assumed inputs, at the coefficients checked last.
class InputChecks {
 public:
  InputChecks(const Problem& problem, const Budget& budget, JobRunner& runner,
              StudyOutcome& outcome)
      : problem_(problem), budget_(budget), runner_(runner), outcome_(outcome) {}

  /// Stiffer grains, in softened experiments. False if interrupted.
  bool make_stiffer() {
    return vary(plan(AssumedInput::stiffness), AssumedInput::stiffness, outcome_.stiffness);
  }

  /// Grains of more spheres, if their surface is known. False if interrupted.
  bool make_finer(const StudySimulator& simulator) {
    ShapeCheck& shape = outcome_.shape;
    shape.spheres = problem_.spheres.count;
    shape.not_made = problem_.spheres.no_closer;
    const SensitivityPlan finer = plan(AssumedInput::spheres);
    const auto varied =
        std::ranges::find_if(finer.jobs, [](const Job& job) { return job.inputs.spheres != 1; });
    if (varied != finer.jobs.end()) {
      try {
        const dem::ClumpFile& grain = simulator.finer_grain(varied->inputs.spheres);
        shape.finer_spheres = static_cast<int>(grain.shape.spheres.size());
        shape.finer_volume_error = grain.errors.volume_error;
      } catch (const base::InputError& error) {
        shape.not_made = fmt::format("more spheres cannot be made: {}", error.what());
        return true;
      }
    }
    return vary(finer, AssumedInput::spheres, shape);
  }

 private:
  SensitivityPlan plan(AssumedInput input) const {
    return plan_sensitivity(problem_, input, outcome_.best.values, budget_.verification_repeats,
                            made_);
  }

  bool vary(const SensitivityPlan& plan, AssumedInput input, Sensitivity& found) {
    const InputWords words = words_of(input, problem_, 0);
    const bool is_largest = budget_.settings.budget_s >= budget_named("standard").settings.budget_s;
    found.over_budget = plan.over_budget;
    for (const std::string& experiment : plan.over_budget) {
      outcome_.notes.push_back(fmt::format(
          "{}: it is not known {} would take more than a fifth of this budget. Fix: {}.",
          experiment, words.over_budget, is_largest ? words.by_hand : "the budget standard"));
    }
    if (plan.jobs.empty()) return true;
    const auto runs = runner_.get(words.stage, plan.jobs, 0);
    if (!runs) return false;
    made_.insert(made_.end(), plan.jobs.begin(), plan.jobs.end());
    runs_ = joined(std::move(runs_), *runs);
    found.readings = check_sensitivity(problem_, input, outcome_.best.values,
                                       joined(outcome_.runs, runs_), outcome_.fit);
    found.coefficients = moved_coefficients(problem_, found.readings, outcome_.runs);
    return true;
  }

  const Problem& problem_;
  const Budget& budget_;
  JobRunner& runner_;
  StudyOutcome& outcome_;
  std::vector<Job> made_;
  std::vector<Run> runs_;
};

/// Varies the inputs that are known inexactly, one after the other. False if interrupted.
bool vary_inputs(const Problem& problem, JobRunner& runner, StudyOutcome& outcome) {
  std::vector<Job> own;
  for (const Run& run : outcome.checks) own.push_back(run.job);
  InputPlan plan = plan_inputs(problem, own);
  std::vector<Run> varied;
  for (std::size_t k = 0; k < plan.inputs.size(); ++k) {
    const FixedInput& input = problem.fixed_inputs[k];
    std::vector<Job> jobs = plan.jobs;
    std::erase_if(jobs, [&](const Job& job) { return job.inputs.step != input.step; });
    if (jobs.empty()) continue;
    try {
      const auto runs = runner.get("varying " + input.name, jobs, 0);
      if (!runs) return false;
      varied = joined(std::move(varied), *runs);
    } catch (const StoreError&) {
      throw;  // says nothing about the changed study
    } catch (const base::InputError& error) {
      plan.inputs[k].not_varied = input.experiments;
      outcome.notes.push_back(fmt::format("{} cannot be varied by its uncertainty, {:g} {}: {}",
                                          input.name, input.sd, input.unit, error.what()));
    }
  }
  outcome.inputs =
      effects_of_inputs(problem, plan, outcome.checks, varied, outcome.fit, outcome.runs);
  outcome.combined = combined_effects(problem, outcome.fit, outcome.inputs);
  return true;
}

/// Notes coefficients less certain because of fixed inputs than of all else, and what is open.
void note_inputs(StudyOutcome& outcome) {
  for (const CombinedEffect& combined : outcome.combined) {
    if (!(combined.effect > combined.half_width)) continue;
    outcome.notes.push_back(fmt::format(
        "{}: inputs that were held fixed, each within its own uncertainty, move it by ± {:.2g} "
        "(95 %), and its interval is ± {:.2g}. With them it is {:.3g} to {:.3g}. Fix: measure what "
        "moves it most (assumed_inputs), and state its uncertainty in [uncertainty].",
        combined.name, combined.effect, combined.half_width, combined.interval.low,
        combined.interval.high));
  }
  std::string open;
  for (const InputEffect& effect : outcome.inputs) {
    if (effect.not_varied.empty()) continue;
    open += fmt::format("{}{} ({})", open.empty() ? "" : ", ", effect.input,
                        fmt::join(effect.not_varied, ", "));
  }
  if (open.empty()) return;
  outcome.notes.push_back(fmt::format(
      "what these inputs move is not known in the experiments named: {}. Simulating that would "
      "take more than a fifth of this budget, or cannot be done. Fix: a larger budget.",
      open));
}

/// Notes readings that another value of an assumed input changes.
void note_sensitivity(const Problem& problem, const Sensitivity& found,
                      std::vector<std::string>& notes) {
  for (const SensitivityCheck& check : found.readings) {
    if (check.verdict != AgreementVerdict::disagrees) continue;
    const InputWords words = words_of(check.input, problem, check.value);
    if (check.runs == 0) {
      notes.push_back(
          fmt::format("{}: {} no run has this reading, and the study's grains do. Fix: {}.",
                      check.name, words.other, words.fix));
      continue;
    }
    const std::string seen_in =
        check.grain_size == 1
            ? ""
            : fmt::format(", seen in grains {:.3g} times as large", check.grain_size);
    notes.push_back(
        fmt::format("{}: {}: {} it changes by {:+.3g} {} (95 %: {:.3g} to {:.3g}{}), and the "
                    "bench's mean is known within {:.2g}. Fix: {}.",
                    check.name, words.matters, words.other, check.change, check.unit,
                    check.interval.low, check.interval.high, seen_in, check.limit, words.fix));
  }
}

/// Notes if the last check moved the fit by more than the uncertainty of that check.
void note_last_step(StudyOutcome& outcome) {
  const PredictedSet& checked = outcome.fit.asked.front();
  std::string moved;
  for (std::size_t i = 0; i < outcome.fit.observables.size(); ++i) {
    const FittedObservable& fitted = outcome.fit.observables[i];
    const double step = fitted.simulated - checked.simulated[i];
    const double unseen = outcome.best.observables[i].simulated_uncertainty;
    if (std::abs(step) <= std::max(kNear * fitted.measured_uncertainty, unseen)) continue;
    moved +=
        fmt::format("{}{} {:+.3g} {}", moved.empty() ? "" : ", ", fitted.name, step, fitted.unit);
  }
  if (moved.empty()) return;
  outcome.notes.push_back(fmt::format(
      "after {} rounds of checks the coefficients still change: according to the surrogates, those "
      "reported differ from those checked last by: {}. A larger budget would settle them.",
      outcome.check_rounds, moved));
}

void note_checks(StudyOutcome& outcome) {
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
  note_last_step(outcome);
}

/// All simulations and fits; false if interrupted.
bool run_to_the_end(const Problem& problem, const Budget& budget, const StudyContext& context,
                    JobRunner& runner, StudyOutcome& outcome) {
  std::vector<std::vector<double>> tried;
  try {
    const FitWatch watch(context.is_interrupted);
    if (!run_rounds(problem, budget, runner, outcome.runs)) return false;
    if (!simulate_equivalent_sets(problem, budget, runner, tried, outcome)) return false;
    if (!fit_and_check(problem, budget, runner, tried, outcome)) return false;
    judge_family(problem, outcome);
    outcome.assumed_scatters = assumed_scatters(problem, outcome.runs, outcome.fit);
    if (!predict(problem, runner, outcome)) return false;
    InputChecks checks(problem, budget, runner, outcome);
    if (!checks.make_stiffer() || !checks.make_finer(context.simulator)) return false;
    return vary_inputs(problem, runner, outcome);
  } catch (const FitInterrupted&) {
    return false;
  }
}

/// Passes on the results of the complete rounds, which takes as long as a fit.
void leave(const Problem& problem, const StudyContext& context, const JobRunner& runner,
           const std::vector<Run>& runs) {
  if (!context.leave || runs.empty()) return;
  try {
    context.leave({.stage = runner.stage(), .fit = fit_jointly(problem, runs), .runs = runs});
  } catch (const base::InputError&) {
    return;  // too few runs have a reading: nothing is known yet
  }
}

}  // namespace

std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& asked,
                                      const StudyContext& context) {
  const Budget budget = with_affordable_checks(asked, problem);
  JobRunner runner(problem, context);
  StudyOutcome outcome;
  if (!run_to_the_end(problem, budget, context, runner, outcome)) {
    leave(problem, context, runner, outcome.runs);
    return std::nullopt;
  }
  note_checks(outcome);
  note_sensitivity(problem, outcome.stiffness, outcome.notes);
  note_sensitivity(problem, outcome.shape, outcome.notes);
  note_inputs(outcome);
  note_missing_grains(outcome.notes, outcome.runs);
  outcome.heap_angles_deg = heap_angles_deg(context, outcome.checks);
  outcome.simulated = runner.simulated();
  outcome.reused = runner.reused();
  return outcome;
}

}  // namespace repose::calibrate
