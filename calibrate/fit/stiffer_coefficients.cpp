#include "calibrate/fit/stiffer_coefficients.h"

#include <algorithm>
#include <cmath>

#include "base/distributions.h"

namespace repose::calibrate {
namespace {

bool is_known(const StiffnessCheck& check) {
  return std::isfinite(check.change) && std::isfinite(check.interval.low) &&
         std::isfinite(check.interval.high);
}

/// Softer grains than those of the bench read as much less as stiffening them adds.
void take_from(Observable& observable, const StiffnessCheck& check) {
  observable.mean = std::clamp(observable.mean - check.change, observable.least, observable.most);
  const double half = (check.interval.high - check.interval.low) / 2;
  observable.shift_sd = std::hypot(observable.shift_sd, half / base::kNormal95);
}

}  // namespace

std::vector<StifferCoefficient> stiffer_coefficients(const Problem& problem,
                                                     const std::vector<StiffnessCheck>& checks,
                                                     const std::vector<Run>& runs) {
  Problem stiffer = problem;
  bool is_any = false;
  for (Observable& observable : stiffer.observables) {
    const auto check = std::ranges::find(checks, observable.name, &StiffnessCheck::name);
    if (check == checks.end() || !is_known(*check)) continue;
    take_from(observable, *check);
    is_any = true;
  }
  if (!is_any) return {};
  std::vector<StifferCoefficient> coefficients;
  for (const FittedParameter& fitted : fit_jointly(stiffer, runs).parameters) {
    coefficients.push_back({fitted.name, fitted.value, fitted.interval, fitted.verdict});
  }
  return coefficients;
}

}  // namespace repose::calibrate
