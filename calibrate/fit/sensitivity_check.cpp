#include "calibrate/fit/sensitivity_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/distributions.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

namespace {

constexpr std::uint64_t kFirstSensitivitySeed = kFirstCheckSeed + 700'000'000;
constexpr double kStiffer = 10;
constexpr int kMoreSpheres = 4;
constexpr double kMaxOfBudget = .2;
constexpr int kFewestRepeats = 5;
constexpr int kCoarseRepeats = 24;  // cheap, and each scatters more than a full run
constexpr double kInterval = .975;

/// The value to be simulated, and its multiple of the study's value; 1 if none is closer to reality
/// than the study's.
struct Nearer {
  double value = 1;
  double multiple = 1;
  AssumedInputs inputs = {};
};

Nearer nearer(const Problem& problem, const Experiment& experiment, AssumedInput input) {
  Nearer found;
  found.inputs = experiment.usual_inputs();
  if (input == AssumedInput::stiffness) {
    found.multiple = std::min(kStiffer, experiment.real_stiffness);
    found.value = found.multiple / experiment.real_stiffness;
    found.inputs.stiffness = found.multiple;
  } else {
    const GrainSpheres& spheres = problem.spheres;
    found.value = std::max(spheres.count, std::min(kMoreSpheres * spheres.count, spheres.most));
    found.multiple = found.value / spheres.count;
    found.inputs.spheres = found.multiple;
  }
  return found;
}

bool is_of(const std::vector<Observable>& observables, const Experiment& experiment) {
  return std::ranges::any_of(observables, [&](const Observable& observable) {
    return observable.experiment == experiment.name;
  });
}

/// Jobs already made cost nothing, and are not made again.
void add_jobs(const Problem& problem, const Experiment& experiment,
              const std::vector<double>& values, int repeats, const AssumedInputs& inputs,
              const std::vector<Job>& made, SensitivityPlan& plan) {
  for (int k = 0; k < (experiment.is_stochastic ? repeats : 1); ++k) {
    Job job = job_at(problem, experiment, to_unit(problem, values),
                     problem.settings.seed + kFirstSensitivitySeed + static_cast<std::uint64_t>(k));
    job.inputs = inputs;
    if (std::ranges::find(made, job) != made.end()) continue;
    plan.run_s += run_s_of(experiment, inputs);
    plan.jobs.push_back(std::move(job));
  }
}

/// For one experiment alone.
SensitivityPlan plan_of(const Problem& problem, const Experiment& experiment,
                        const AssumedInputs& inputs, const std::vector<double>& values, int repeats,
                        const std::vector<Job>& made) {
  SensitivityPlan plan;
  if (!is_of(problem.observables, experiment) || experiment.coarse) {
    add_jobs(problem, experiment, values, repeats, experiment.usual_inputs(), made, plan);
  }
  add_jobs(problem, experiment, values, repeats, inputs, made, plan);
  return plan;
}

/// The same with fewer repeats if they would take too long; std::nullopt if even the fewest do.
std::optional<SensitivityPlan> plan_within(double seconds, const Problem& problem,
                                           const Experiment& experiment,
                                           const AssumedInputs& inputs,
                                           const std::vector<double>& values, int repeats,
                                           const std::vector<Job>& made) {
  for (int fewer = repeats; fewer >= std::min(kFewestRepeats, repeats); --fewer) {
    SensitivityPlan plan = plan_of(problem, experiment, inputs, values, fewer, made);
    if (plan.run_s <= seconds) return plan;
  }
  return std::nullopt;
}

/// A measured mean and its index in the fit; `fit` is null if it is held out.
struct Asked {
  const Observable& observable;
  const JointFit* fit;
  std::size_t number;

  UncertainMean mean(const CheckSample& sample, const Experiment& experiment) const {
    return mean_of(sample, experiment.is_stochastic, fit, number);
  }
};

/// Of the measured mean; an assumed scatter counts as known.
double half_width_95(const Asked& asked) {
  const Observable& observable = asked.observable;
  return base::student_t_quantile(kInterval,
                                  std::min(degrees_of_scatter(observable), base::kManyDf)) *
         (asked.fit != nullptr ? asked.fit->observables[asked.number].measured_uncertainty
                               : with_systematic(observable, standard_uncertainty(observable)));
}

void judge(const UncertainMean& change, double level, SensitivityCheck& check) {
  check.change = change.value;
  check.uncertainty = change.uncertainty;
  const double half = base::student_t_quantile(kInterval, change.df) * change.uncertainty;
  check.interval = {change.value - half, change.value + half};
  check.chance = chance_of(change);
  const Interval within = equivalence_interval(change);
  if (within.low >= -check.limit && within.high <= check.limit) {
    if (check.failed_runs == 0) check.verdict = AgreementVerdict::agrees;
  } else if (check.chance < level &&
             (check.interval.low > check.limit || check.interval.high < -check.limit)) {
    check.verdict = AgreementVerdict::disagrees;
  }
}

/// std::nullopt if no other value was simulated.
std::optional<SensitivityCheck> check_of(const Problem& problem, AssumedInput input,
                                         const std::vector<double>& values,
                                         const std::vector<Run>& runs, const Asked& asked,
                                         double level) {
  const Observable& observable = asked.observable;
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  const Nearer other = nearer(problem, experiment, input);
  if (other.multiple <= 1) return std::nullopt;
  const CheckSample changed = check_sample(problem, values, observable, runs, other.inputs);
  const CheckSample own =
      check_sample(problem, values, observable, runs, experiment.usual_inputs());
  if (changed.count() + changed.failed == 0) return std::nullopt;
  SensitivityCheck check{.name = observable.name,
                         .unit = observable.unit,
                         .input = input,
                         .multiple = other.multiple,
                         .value = other.value,
                         .grain_size = other.inputs.size,
                         .change = kNone,
                         .uncertainty = kNone,
                         .interval = {kNone, kNone},
                         .chance = kNone,
                         .limit = half_width_95(asked),
                         .runs = changed.count(),
                         .failed_runs = changed.failed};
  // Larger grains may form no heap where the study's do.
  const bool is_full = check.grain_size == 1;
  if (is_full && changed.count() == 0 && own.count() > 0) {
    check.verdict = AgreementVerdict::disagrees;
  }
  const UncertainMean change =
      difference_of(asked.mean(changed, experiment), asked.mean(own, experiment));
  if (std::isfinite(change.value) && std::isfinite(change.uncertainty)) {
    judge(change, level, check);
  }
  return check;
}

}  // namespace

SensitivityPlan plan_sensitivity(const Problem& problem, AssumedInput input,
                                 const std::vector<double>& values, int repeats,
                                 const std::vector<Job>& made) {
  const auto inputs_of = [&](const Experiment& experiment) {
    return nearer(problem, experiment, input).inputs;
  };
  std::vector<Experiment> open;
  for (const Experiment& experiment : problem.experiments) {
    const bool is_measured =
        is_of(problem.observables, experiment) || is_of(problem.held_out, experiment);
    if (is_measured && nearer(problem, experiment, input).multiple > 1) open.push_back(experiment);
  }
  std::ranges::stable_sort(open, {}, [&](const Experiment& experiment) {
    return run_s_of(experiment, inputs_of(experiment));
  });
  SensitivityPlan plan;
  for (const Experiment& experiment : open) {
    const double left_s = kMaxOfBudget * problem.settings.budget_s - plan.run_s;
    const int wanted = experiment.coarse ? std::max(repeats, kCoarseRepeats) : repeats;
    const auto one =
        plan_within(left_s, problem, experiment, inputs_of(experiment), values, wanted, made);
    if (!one) {
      plan.over_budget.push_back(experiment.name);
      continue;
    }
    plan.run_s += one->run_s;
    plan.jobs.insert(plan.jobs.end(), one->jobs.begin(), one->jobs.end());
  }
  return plan;
}

std::vector<SensitivityCheck> check_sensitivity(const Problem& problem, AssumedInput input,
                                                const std::vector<double>& values,
                                                const std::vector<Run>& runs, const JointFit& fit) {
  const double level =
      kLevel / static_cast<double>(problem.observables.size() + problem.held_out.size());
  std::vector<SensitivityCheck> checks;
  const auto add = [&](const Asked& asked) {
    const auto check = check_of(problem, input, values, runs, asked, level);
    if (check) checks.push_back(*check);
  };
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    add({problem.observables[i], &fit, i});
  }
  for (const Observable& observable : problem.held_out) add({observable, nullptr, 0});
  return checks;
}

namespace {

bool is_known(const SensitivityCheck& check) {
  return std::isfinite(check.change) && std::isfinite(check.interval.low) &&
         std::isfinite(check.interval.high);
}

/// Range of what the study's grains would read where the bench's read `mean`. `change`: effect of
/// making them more like the bench's, which adds to a reading at one end, scales it at the other.
Interval without(double mean, double change) {
  const double added = mean - change;
  const bool can_go_with_it = mean > 0 && mean + change > 0;
  return {added, can_go_with_it ? mean * mean / (mean + change) : added};
}

/// One pair of readings shows neither which of the two it is, nor what lies between: uses the
/// middle, and the standard deviation of a value anywhere in between (JCGM 100:2008, GUM, 4.3.7).
void take_from(Observable& observable, const SensitivityCheck& check) {
  const auto readable = [&](double reading) {
    return std::clamp(reading, observable.least, observable.most);
  };
  const auto [added, multiplied] = without(observable.mean, check.change);
  const double width = std::abs(readable(multiplied) - readable(added));
  const double half = (check.interval.high - check.interval.low) / 2;
  observable.mean = (readable(added) + readable(multiplied)) / 2;
  observable.shift_sd =
      std::hypot(observable.shift_sd, half / base::kNormal95, width / std::sqrt(12));
}

}  // namespace

std::vector<MovedCoefficient> moved_coefficients(const Problem& problem,
                                                 const std::vector<SensitivityCheck>& checks,
                                                 const std::vector<Run>& runs) {
  Problem moved = problem;
  bool is_any = false;
  for (Observable& observable : moved.observables) {
    const auto check = std::ranges::find(checks, observable.name, &SensitivityCheck::name);
    if (check == checks.end() || !is_known(*check)) continue;
    take_from(observable, *check);
    is_any = true;
  }
  if (!is_any) return {};
  std::vector<MovedCoefficient> coefficients;
  for (const FittedParameter& fitted : fit_jointly(moved, runs).parameters) {
    coefficients.push_back({fitted.name, fitted.value, fitted.interval, fitted.verdict});
  }
  return coefficients;
}

}  // namespace repose::calibrate
