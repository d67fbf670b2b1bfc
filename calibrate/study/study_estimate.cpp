#include "calibrate/study/study_estimate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/input_effects.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/sensitivity_check.h"
#include "calibrate/fit/verification.h"
#include "calibrate/study/study_run.h"

namespace repose::calibrate {
namespace {

using Clock = std::chrono::steady_clock;

/// Each experiment is wanted as much as it has coefficients.
std::vector<double> needs_of(const std::vector<Experiment>& experiments) {
  std::vector<double> needs;
  for (const Experiment& experiment : experiments) {
    needs.push_back(static_cast<double>(experiment.parameters.size()));
  }
  return needs;
}

std::vector<int> fit_runs(const Problem& problem, const std::vector<Experiment>& experiments) {
  std::vector<int> runs = first_round_jobs(problem);
  Cost left{problem.settings.budget_s, problem.settings.max_jobs};
  std::vector<int> round = runs;
  for (int rounds_left = problem.settings.max_rounds - 1; rounds_left > 0; --rounds_left) {
    for (std::size_t e = 0; e < round.size(); ++e) {
      left.seconds -= round[e] * experiments[e].run_s;
      left.jobs -= round[e];
    }
    round = round_jobs(problem, needs_of(experiments), left, rounds_left);
    for (std::size_t e = 0; e < round.size(); ++e) runs[e] += round[e];
  }
  return runs;
}

/// Wherever the coefficients are, a check has as many jobs.
std::vector<double> middle_of(const Problem& problem) {
  std::vector<double> middle;
  for (const Parameter& parameter : problem.parameters) {
    middle.push_back((parameter.min + parameter.max) / 2);
  }
  return middle;
}

/// Of one experiment, in a check with so many repeats of the dearest.
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

/// Of inputs held fixed, wherever the coefficients are.
InputPlan input_plan(const Problem& problem, int repeats) {
  return plan_inputs(problem, verification_jobs(problem, middle_of(problem), repeats, 0));
}

/// Of the last runs: those of stiffer grains, of grains of more spheres, and of other inputs.
void count_last_runs(const Problem& problem, int repeats,
                     std::vector<ExperimentEstimate>& estimates) {
  std::vector<Job> jobs = input_plan(problem, repeats).jobs;
  for (const AssumedInput input : {AssumedInput::stiffness, AssumedInput::spheres}) {
    const auto more = plan_sensitivity(problem, input, middle_of(problem), repeats).jobs;
    jobs.insert(jobs.end(), more.begin(), more.end());
  }
  for (ExperimentEstimate& estimate : estimates) {
    for (const Job& job : jobs) {
      if (job.experiment != estimate.experiment) continue;
      if (job.inputs == AssumedInputs{}) {
        ++estimate.check_runs;
        continue;
      }
      ++estimate.varied_runs;
      estimate.varied_s += run_s_of(experiment_named(problem, job.experiment), job.inputs);
    }
  }
}

}  // namespace

std::vector<ExperimentEstimate> estimate_of(const Problem& problem, const Budget& budget) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const std::vector<int> runs = fit_runs(problem, experiments);
  std::vector<ExperimentEstimate> estimates;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const std::string& name = experiments[e].name;
    const int checks = (kMaxCheckRounds - 1) * check_runs(problem, name, budget.round_repeats) +
                       check_runs(problem, name, budget.verification_repeats) +
                       budget.family_sets * check_runs(problem, name, kFamilyRepeats);
    estimates.push_back({.experiment = name,
                         .run_s = experiments[e].run_s,
                         .fit_runs = runs[e],
                         .check_runs = checks,
                         .varied_runs = 0,
                         .varied_s = 0});
  }
  for (const Experiment& experiment : held_out_experiments(problem)) {
    estimates.push_back({.experiment = experiment.name,
                         .run_s = experiment.run_s,
                         .fit_runs = 0,
                         .check_runs = prediction_runs(experiment),
                         .varied_runs = 0,
                         .varied_s = 0});
  }
  count_last_runs(problem, budget.verification_repeats, estimates);
  return estimates;
}

double last_runs_s(const Problem& problem, int repeats) {
  double seconds = input_plan(problem, repeats).run_s;
  for (const AssumedInput input : {AssumedInput::stiffness, AssumedInput::spheres}) {
    seconds += plan_sensitivity(problem, input, middle_of(problem), repeats).run_s;
  }
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
  double sum = 0;  // shared as rounds of the fit are, see first_round_jobs
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    sum += needs[e] * std::sqrt(experiments[e].run_s);
  }
  std::vector<int> runs;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const double bought = seconds * needs[e] / std::sqrt(experiments[e].run_s) / sum;
    runs.push_back(static_cast<int>(std::min(bought, kMax)));
  }
  return runs;
}

double timed_run_s(const RunSpec& spec, std::uint64_t seed, double longest_s,
                   const std::atomic<bool>& is_interrupted) {
  const Clock::time_point start = Clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::mutex reporting;
  double fraction = 0;
  const SimulateOptions options{.trajectory = {}, .report = [&](double done) {
                                  const std::scoped_lock lock(reporting);
                                  fraction = std::max(fraction, done);
                                  return !is_interrupted &&
                                         (fraction <= 0 || elapsed_s() < longest_s);
                                }};
  try {
    simulate_experiment(spec, seed, options);
    return elapsed_s();
  } catch (const dem::Interrupted&) {
    if (is_interrupted) throw;
    return elapsed_s() / fraction;
  }
}

}  // namespace repose::calibrate
