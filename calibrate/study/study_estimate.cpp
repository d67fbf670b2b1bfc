#include "calibrate/study/study_estimate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/input_effects.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/sensitivity_check.h"
#include "calibrate/fit/verification.h"
#include "calibrate/study/study_run.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {
namespace {

using Clock = std::chrono::steady_clock;

/// Each experiment is weighted by its number of coefficients.
std::vector<double> needs_of(const std::vector<Experiment>& experiments) {
  std::vector<double> needs;
  for (const Experiment& experiment : experiments) {
    needs.push_back(static_cast<double>(experiment.parameters.size()));
  }
  return needs;
}

/// For the rounds after the first.
std::vector<int> later_runs(const Problem& problem, const std::vector<Experiment>& experiments,
                            std::vector<int> round) {
  std::vector<int> runs(round.size(), 0);
  Cost left{problem.settings.budget_s, problem.settings.max_jobs};
  for (int rounds_left = problem.settings.max_rounds - 1; rounds_left > 0; --rounds_left) {
    for (std::size_t e = 0; e < round.size(); ++e) {
      left.seconds -= round[e] * usual_run_s(experiments[e]);
      left.jobs -= round[e];
    }
    round = round_jobs(problem, needs_of(experiments), left, rounds_left);
    for (std::size_t e = 0; e < round.size(); ++e) runs[e] += round[e];
  }
  return runs;
}

/// A check has the same number of jobs wherever the coefficients are.
std::vector<double> middle_of(const Problem& problem) {
  std::vector<double> middle;
  for (const Parameter& parameter : problem.parameters) {
    middle.push_back((parameter.min + parameter.max) / 2);
  }
  return middle;
}

/// Runs of one experiment, in a check with `repeats` of the most expensive one.
int check_runs(const Problem& problem, const std::string& experiment, int repeats) {
  return static_cast<int>(std::ranges::count(
      verification_jobs(problem, middle_of(problem), repeats, 0), experiment, &Job::experiment));
}

double run_s_of_all(const Problem& problem, const std::vector<Job>& jobs) {
  double seconds = 0;
  for (const Job& job : jobs) {
    seconds += run_s_of(experiment_named(problem, job.experiment), job.inputs);
  }
  return seconds;
}

/// For inputs held fixed, wherever the coefficients are.
InputPlan input_plan(const Problem& problem, int repeats) {
  return plan_inputs(problem, verification_jobs(problem, middle_of(problem), repeats, 0));
}

void count(Phase phase, const Problem& problem, const std::vector<Job>& jobs,
           std::vector<ExperimentEstimate>& estimates) {
  for (ExperimentEstimate& estimate : estimates) {
    PhaseWork& work = estimate.phases[phase];
    for (const Job& job : jobs) {
      if (job.experiment != estimate.experiment) continue;
      ++work.runs;
      work.seconds += run_s_of(experiment_named(problem, job.experiment), job.inputs);
    }
  }
}

void count(Phase phase, int runs, ExperimentEstimate& estimate) {
  estimate.phases[phase] = {.runs = runs, .seconds = runs * estimate.run_s};
}

/// For stiffer grains, and then for more spheres.
std::pair<SensitivityPlan, SensitivityPlan> sensitivity_plans(const Problem& problem, int repeats) {
  const std::vector<double> middle = middle_of(problem);
  SensitivityPlan stiffness = plan_sensitivity(problem, AssumedInput::stiffness, middle, repeats);
  SensitivityPlan spheres =
      plan_sensitivity(problem, AssumedInput::spheres, middle, repeats, stiffness.jobs);
  return {std::move(stiffness), std::move(spheres)};
}

/// Of the last runs: those of stiffer grains, of grains of more spheres, and with other inputs.
void count_last_runs(const Problem& problem, int repeats,
                     std::vector<ExperimentEstimate>& estimates) {
  const auto [stiffness, spheres] = sensitivity_plans(problem, repeats);
  count(Phase::stiffness, problem, stiffness.jobs, estimates);
  count(Phase::spheres, problem, spheres.jobs, estimates);
  count(Phase::inputs, problem, input_plan(problem, repeats).jobs, estimates);
}

}  // namespace

std::string_view name_of(Phase phase) {
  switch (phase) {
    case Phase::first_round:
      return "first round";
    case Phase::later_rounds:
      return "later rounds";
    case Phase::equal_sets:
      return "equally good sets";
    case Phase::checks:
      return "checks";
    case Phase::held_out:
      return "what is held out";
    case Phase::stiffness:
      return "stiffer grains";
    case Phase::spheres:
      return "more spheres";
    case Phase::inputs:
      return "inputs held fixed, varied";
  }
  return {};
}

PhaseWork ExperimentEstimate::of(Phase phase) const {
  const auto found = phases.find(phase);
  return found == phases.end() ? PhaseWork{} : found->second;
}

int ExperimentEstimate::fit_runs() const {
  return of(Phase::first_round).runs + of(Phase::later_rounds).runs;
}

PhaseWork ExperimentEstimate::all() const {
  PhaseWork sum;
  for (const auto& [phase, work] : phases) {
    sum.runs += work.runs;
    sum.seconds += work.seconds;
  }
  return sum;
}

std::vector<ExperimentEstimate> estimate_of(const Problem& problem, const Budget& asked) {
  const Budget budget = with_affordable_checks(asked, problem);
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const std::vector<int> first = first_round_jobs(problem);
  const std::vector<int> later = later_runs(problem, experiments, first);
  std::vector<ExperimentEstimate> estimates;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const std::string& name = experiments[e].name;
    ExperimentEstimate& estimate = estimates.emplace_back(
        ExperimentEstimate{.experiment = name, .run_s = experiments[e].run_s});
    const double usual_s = usual_run_s(experiments[e]);
    estimate.phases[Phase::first_round] = {.runs = first[e], .seconds = first[e] * usual_s};
    estimate.phases[Phase::later_rounds] = {.runs = later[e], .seconds = later[e] * usual_s};
    count(Phase::equal_sets, budget.family_sets * check_runs(problem, name, kFamilyRepeats),
          estimate);
    count(Phase::checks,
          (budget.check_rounds - 1) * check_runs(problem, name, budget.round_repeats) +
              check_runs(problem, name, budget.verification_repeats),
          estimate);
  }
  for (const Experiment& experiment : held_out_experiments(problem)) {
    ExperimentEstimate& estimate = estimates.emplace_back(
        ExperimentEstimate{.experiment = experiment.name, .run_s = experiment.run_s});
    count(Phase::held_out, prediction_runs(experiment), estimate);
  }
  count_last_runs(problem, budget.verification_repeats, estimates);
  return estimates;
}

std::string foreseen(const std::vector<ExperimentEstimate>& estimates) {
  constexpr double kPercent = 100;
  PhaseWork all;
  std::map<Phase, PhaseWork> phases;
  for (const ExperimentEstimate& estimate : estimates) {
    for (const auto& [phase, work] : estimate.phases) {
      for (PhaseWork* sum : {&phases[phase], &all}) {
        sum->runs += work.runs;
        sum->seconds += work.seconds;
      }
    }
  }
  std::string parts;
  for (const auto& [phase, work] : phases) {
    if (work.runs == 0) continue;
    parts += fmt::format("{}{} {} ({:.0f} %)", parts.empty() ? "" : ", ", name_of(phase), work.runs,
                         kPercent * work.seconds / all.seconds);
  }
  return fmt::format("at most {} simulations, with their shares of the work: {}", all.runs, parts);
}

double last_runs_s(const Problem& problem, int repeats) {
  const auto [stiffness, spheres] = sensitivity_plans(problem, repeats);
  double seconds = input_plan(problem, repeats).run_s + stiffness.run_s + spheres.run_s;
  for (const Experiment& experiment : held_out_experiments(problem)) {
    seconds += experiment.run_s * prediction_runs(experiment);
  }
  return seconds;
}

double checks_s(const Problem& problem, const Budget& budget, int rounds) {
  const auto check_s = [&](int repeats) {
    return run_s_of_all(problem, verification_jobs(problem, middle_of(problem), repeats, 0));
  };
  return (rounds - 1) * check_s(budget.round_repeats) + check_s(budget.verification_repeats);
}

std::vector<int> runs_for(const Problem& problem, double seconds) {
  constexpr double kMax = 1e6;
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const std::vector<double> needs = needs_of(experiments);
  double sum = 0;  // shared like rounds of the fit, see first_round_jobs
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    sum += needs[e] * std::sqrt(usual_run_s(experiments[e]));
  }
  std::vector<int> runs;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const double bought = seconds * needs[e] / std::sqrt(usual_run_s(experiments[e])) / sum;
    runs.push_back(static_cast<int>(std::min(bought, kMax)));
  }
  return runs;
}

std::optional<double> foreseen_s(const std::vector<WorkLook>& looks, double all_clump_steps) {
  if (looks.empty() || !(looks.back().clump_steps > 0)) return std::nullopt;
  const WorkLook& last = looks.back();
  const auto middle = std::ranges::find_if(
      looks, [&](const WorkLook& look) { return look.seconds >= last.seconds / 2; });
  const WorkLook from = middle->clump_steps < last.clump_steps ? *middle : WorkLook{};
  const double step_s = (last.seconds - from.seconds) / (last.clump_steps - from.clump_steps);
  return last.seconds + step_s * std::max(0., all_clump_steps - last.clump_steps);
}

double timed_run_s(const RunSpec& spec, std::uint64_t seed, double run_s, double longest_s,
                   const std::atomic<bool>& is_interrupted) {
  const Clock::time_point start = Clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::mutex reporting;
  double fraction = 0;
  std::vector<WorkLook> looks;
  const SimulateOptions options{.trajectory = {},
                                .report =
                                    [&](double done) {
                                      const std::scoped_lock lock(reporting);
                                      fraction = std::max(fraction, done);
                                      return !is_interrupted &&
                                             (fraction <= 0 || elapsed_s() < longest_s);
                                    },
                                .watch_work =
                                    [&](double clump_steps) {
                                      looks.push_back({elapsed_s(), clump_steps});
                                    }};
  try {
    simulate_experiment(spec, seed, options);
    return elapsed_s();
  } catch (const dem::Interrupted&) {
    if (is_interrupted) throw;
    const auto by_work = spec.entry().is_bulk
                             ? foreseen_s(looks, run_s / dem::bulk_step_s(spec.model))
                             : std::nullopt;
    return by_work.value_or(elapsed_s() / fraction);
  }
}

}  // namespace repose::calibrate
