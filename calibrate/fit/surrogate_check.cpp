#include "calibrate/fit/surrogate_check.h"

#include <cmath>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr double kMattersInUncertainty = .5;  // of the uncertainty of measurement

SurrogateCheck check_of(const Problem& problem, const JointFit& fit, std::size_t i,
                        const CheckSample& sample) {
  const FittedObservable& fitted = fit.observables[i];
  const bool is_stochastic =
      experiment_named(problem, problem.observables[i].experiment).is_stochastic;
  SurrogateCheck check{.observable = fitted.name,
                       .predicted = fitted.simulated,
                       .uncertainty = fitted.simulated_uncertainty,
                       .simulated = sample.count() > 0 ? sample.mean() : kNone,
                       .chance = kNone};
  if (sample.count() < (is_stochastic ? 2 : 1)) return check;
  const RunScatter scatter = is_stochastic ? scatter_of(sample, &fit, i) : RunScatter{};
  const UncertainMean simulated{sample.mean(), scatter.sd / std::sqrt(sample.count()),
                                static_cast<double>(scatter.df)};
  const double surrogate_df = std::max(fit.surrogates[i].runs - 1, 1);
  const UncertainMean difference =
      difference_of(simulated, {check.predicted, check.uncertainty, surrogate_df});
  check.chance = chance_of(difference);
  check.misses = check.chance < kLevel / static_cast<double>(fit.observables.size()) &&
                 std::abs(difference.value) > kMattersInUncertainty * fitted.measured_uncertainty;
  return check;
}

}  // namespace

std::vector<SurrogateCheck> check_surrogates(const Problem& problem, const JointFit& fit,
                                             const std::vector<Run>& runs) {
  std::vector<double> values;
  for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  std::vector<SurrogateCheck> checks;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    checks.push_back(
        check_of(problem, fit, i, check_sample(problem, values, problem.observables[i], runs)));
  }
  return checks;
}

}  // namespace repose::calibrate
