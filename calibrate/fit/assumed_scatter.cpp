#include "calibrate/fit/assumed_scatter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace repose::calibrate {
namespace {

constexpr double kMultiple = 2;      // and its inverse: half
constexpr double kWorthSaying = .1;  // relative change of an interval's width

double width_of(const Interval& interval) { return interval.high - interval.low; }

/// Coefficients refitted to the same runs with all assumed scatters scaled by `multiple`.
std::vector<MovedCoefficient> with_scatter(const Problem& problem, const std::vector<Run>& runs,
                                           const JointFit& fit, double multiple) {
  Problem other = problem;
  for (std::size_t i = 0; i < other.observables.size(); ++i) {
    Observable& observable = other.observables[i];
    if (observable.sd) continue;
    observable.assumed_sd_fraction =
        multiple * fit.observables[i].measured_sd / std::abs(observable.mean);
  }
  std::vector<MovedCoefficient> coefficients;
  for (const FittedParameter& fitted : fit_jointly(other, runs).parameters) {
    coefficients.push_back({fitted.name, fitted.value, fitted.interval, fitted.verdict});
  }
  return coefficients;
}

/// Experiments with an assumed scatter that depend on the parameter.
std::vector<std::string> told_by_assumed(const Problem& problem, std::size_t parameter) {
  std::vector<std::string> names;
  for (const Observable& observable : problem.observables) {
    if (observable.sd) continue;
    const auto experiment =
        std::ranges::find(problem.experiments, observable.experiment, &Experiment::name);
    if (std::ranges::find(experiment->parameters, parameter) == experiment->parameters.end()) {
      continue;
    }
    names.push_back(observable.name);
  }
  return names;
}

bool is_moved(const FittedParameter& assumed, const ScatterDependence& otherwise) {
  const double width = width_of(assumed.interval);
  return std::ranges::any_of(
      std::vector<const MovedCoefficient*>{&otherwise.half, &otherwise.twice},
      [&](const MovedCoefficient* one) {
        return one->verdict != assumed.verdict ||
               std::abs(width_of(one->interval) - width) > kWorthSaying * width;
      });
}

}  // namespace

AssumedScatters assumed_scatters(const Problem& problem, const std::vector<Run>& runs,
                                 const JointFit& fit) {
  AssumedScatters found;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const Observable& observable = problem.observables[i];
    if (observable.sd) continue;
    found.readings.push_back(
        {observable.name, fit.observables[i].measured_sd / std::abs(observable.mean)});
  }
  if (found.readings.empty()) return found;
  const auto half = with_scatter(problem, runs, fit, 1 / kMultiple);
  const auto twice = with_scatter(problem, runs, fit, kMultiple);
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    ScatterDependence dependence{fit.parameters[j].name, {}, half[j], twice[j]};
    if (is_moved(fit.parameters[j], dependence)) {
      dependence.rests_on = told_by_assumed(problem, j);
    }
    found.coefficients.push_back(std::move(dependence));
  }
  return found;
}

}  // namespace repose::calibrate
