#include "calibrate/fit/input_effects.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/distributions.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {
namespace {

constexpr double kInputsOfBudget = .2;
constexpr int kFewestPairs = 5;

/// An input in one experiment, with the check's jobs repeated with it changed.
struct Variation {
  std::size_t input = 0;
  std::vector<Job> jobs;
  double run_s = 0;  ///< of one of them

  double all_s(int repeats) const {
    return run_s * std::min(repeats, static_cast<int>(jobs.size()));
  }
};

std::vector<Variation> variations_of(const Problem& problem, const std::vector<Job>& checks) {
  std::vector<Variation> variations;
  for (std::size_t k = 0; k < problem.fixed_inputs.size(); ++k) {
    const FixedInput& input = problem.fixed_inputs[k];
    for (const std::string& name : input.experiments) {
      Variation variation{.input = k, .jobs = {}};
      for (Job job : checks) {
        if (job.experiment != name) continue;
        job.inputs.step = input.step;
        variation.jobs.push_back(std::move(job));
      }
      if (variation.jobs.empty()) continue;
      variation.run_s = run_s_of(experiment_named(problem, name), variation.jobs.front().inputs);
      variations.push_back(std::move(variation));
    }
  }
  std::ranges::stable_sort(variations, {},
                           [](const Variation& one) { return one.all_s(kFewestPairs); });
  return variations;
}

/// As many repeats of each as there is time for.
int pairs_within(double seconds, const std::vector<Variation>& variations) {
  int pairs = kFewestPairs;
  for (const Variation& variation : variations) {
    pairs = std::max(pairs, static_cast<int>(variation.jobs.size()));
  }
  const auto all_s = [&](int repeats) {
    return std::accumulate(
        variations.begin(), variations.end(), 0.,
        [&](double sum, const Variation& one) { return sum + one.all_s(repeats); });
  };
  while (pairs > kFewestPairs && all_s(pairs) > seconds) --pairs;
  return pairs;
}

/// NaN if a run has no such reading.
double reading_of(const std::vector<Run>& runs, const Job& job, const std::string& name) {
  const auto run = std::ranges::find(runs, job, &Run::job);
  if (run == runs.end() || !run->failure.empty()) return kNone;
  const auto found = run->readings.find(name);
  return found == run->readings.end() ? kNone : found->second;
}

/// The mean difference between runs with the same seed.
InputChange change_of(const Observable& observable, const FixedInput& input, bool is_stochastic,
                      const std::vector<Run>& checks, const std::vector<Run>& varied) {
  CheckSample differences;
  for (const Run& run : varied) {
    if (run.job.experiment != observable.experiment || run.job.inputs.step != input.step) continue;
    Job own = run.job;
    own.inputs.step = {};
    const double difference = reading_of(varied, run.job, observable.reading) -
                              reading_of(checks, own, observable.reading);
    if (std::isfinite(difference)) differences.readings.push_back(difference);
  }
  InputChange change{observable.name, kNone, kNone};
  if (differences.count() < (is_stochastic ? 2 : 1)) return change;
  const double sign = input.step.change < 0 ? -1 : 1;
  change.change = sign * differences.mean();
  change.uncertainty =
      is_stochastic ? differences.sd() / std::sqrt(static_cast<double>(differences.count())) : 0;
  return change;
}

/// How the fit moves when measured means change.
class MovedFit {
 public:
  MovedFit(const Problem& problem, const JointFit& fit, const std::vector<Run>& runs)
      : problem_(problem), misfit_(problem, in_order(problem, runs), {}, true) {
    std::vector<double> values;
    for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
    for (const Observable& observable : problem.observables) means_.push_back(observable.mean);
    start_ = to_unit(problem, values);
    misfit_.inflate_near(start_);
    start_ = minimum_from(misfit_, start_).point;
  }

  /// A simulation that reads more is equivalent to a bench that reads less by the same amount.
  std::vector<double> moved_by(const std::vector<double>& changes) const {
    std::vector<double> means = means_;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Observable& observable = problem_.observables[i];
      means[i] = std::clamp(means[i] - changes[i], observable.least, observable.most);
    }
    const Point there = minimum_from(misfit_.measuring(means), start_).point;
    std::vector<double> moved;
    for (std::size_t j = 0; j < there.size(); ++j) {
      const Parameter& parameter = problem_.parameters[j];
      moved.push_back((there[j] - start_[j]) * (parameter.max - parameter.min));
    }
    return moved;
  }

 private:
  const Problem& problem_;
  Misfit misfit_;
  std::vector<double> means_;
  Point start_;
};

/// With uncertainties propagated from each reading's change, one after the other (JCGM 100:2008,
/// GUM, 5.1.3 note 2).
std::vector<InputChange> coefficients_moved(const Problem& problem, const MovedFit& fit,
                                            const std::vector<InputChange>& readings) {
  std::vector<double> changes, uncertainties;
  for (const Observable& observable : problem.observables) {
    const auto found = std::ranges::find(readings, observable.name, &InputChange::name);
    const bool is_known = found != readings.end() && std::isfinite(found->change);
    changes.push_back(is_known ? found->change : 0);
    uncertainties.push_back(is_known && std::isfinite(found->uncertainty) ? found->uncertainty : 0);
  }
  const std::vector<double> moved = fit.moved_by(changes);
  std::vector<double> squares(moved.size(), 0);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (!(uncertainties[i] > 0)) continue;
    std::vector<double> other = changes;
    other[i] += uncertainties[i];
    const std::vector<double> there = fit.moved_by(other);
    for (std::size_t j = 0; j < moved.size(); ++j) squares[j] += std::pow(there[j] - moved[j], 2);
  }
  std::vector<InputChange> coefficients;
  for (std::size_t j = 0; j < moved.size(); ++j) {
    coefficients.push_back({problem.parameters[j].name, moved[j], std::sqrt(squares[j])});
  }
  return coefficients;
}

}  // namespace

InputPlan plan_inputs(const Problem& problem, const std::vector<Job>& checks) {
  InputPlan plan;
  for (const FixedInput& input : problem.fixed_inputs) {
    plan.inputs.push_back({.input = input.name,
                           .unit = input.unit,
                           .value = input.value,
                           .sd = input.sd,
                           .is_assumed = input.is_assumed,
                           .readings = {},
                           .coefficients = {},
                           .not_varied = {}});
  }
  const std::vector<Variation> variations = variations_of(problem, checks);
  const double most_s = kInputsOfBudget * problem.settings.budget_s;
  const int pairs = pairs_within(most_s, variations);
  for (const Variation& variation : variations) {
    const double run_s = variation.all_s(pairs);
    if (plan.run_s + run_s > most_s) {
      plan.inputs[variation.input].not_varied.push_back(variation.jobs.front().experiment);
      continue;
    }
    plan.run_s += run_s;
    const auto count = std::min(static_cast<std::size_t>(pairs), variation.jobs.size());
    plan.jobs.insert(plan.jobs.end(), variation.jobs.begin(),
                     variation.jobs.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return plan;
}

std::vector<InputEffect> effects_of_inputs(const Problem& problem, const InputPlan& plan,
                                           const std::vector<Run>& checks,
                                           const std::vector<Run>& varied, const JointFit& fit,
                                           const std::vector<Run>& runs) {
  std::vector<InputEffect> effects = plan.inputs;
  if (varied.empty()) return effects;
  const MovedFit moved(problem, fit, runs);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const FixedInput& input = problem.fixed_inputs[k];
    for (const Observable& observable : problem.observables) {
      const bool is_simulated = std::ranges::any_of(varied, [&](const Run& run) {
        return run.job.experiment == observable.experiment && run.job.inputs.step == input.step;
      });
      if (!is_simulated) continue;
      effects[k].readings.push_back(change_of(
          observable, input, experiment_named(problem, observable.experiment).is_stochastic, checks,
          varied));
    }
    if (std::ranges::any_of(effects[k].readings,
                            [](const InputChange& one) { return std::isfinite(one.change); })) {
      effects[k].coefficients = coefficients_moved(problem, moved, effects[k].readings);
    }
  }
  return effects;
}

std::vector<CombinedEffect> combined_effects(const Problem& problem, const JointFit& fit,
                                             const std::vector<InputEffect>& effects) {
  std::vector<CombinedEffect> combined;
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    double squares = 0;
    bool is_any = false;
    for (const InputEffect& effect : effects) {
      if (effect.coefficients.empty()) continue;
      is_any = true;
      squares += std::pow(effect.coefficients[j].change, 2);
    }
    if (!is_any) return {};
    const FittedParameter& parameter = fit.parameters[j];
    const double effect = base::kNormal95 * std::sqrt(squares);
    const auto [low, high] = parameter.interval;
    const Parameter& bounds = problem.parameters[j];
    combined.push_back(
        {.name = parameter.name,
         .value = parameter.value,
         .effect = effect,
         .half_width = (high - low) / 2,
         .interval = {
             std::max(bounds.min, parameter.value - std::hypot(parameter.value - low, effect)),
             std::min(bounds.max, parameter.value + std::hypot(high - parameter.value, effect))}});
  }
  return combined;
}

}  // namespace repose::calibrate
