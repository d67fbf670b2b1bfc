#include "calibrate/fit/moved_coefficients.h"

#include <algorithm>
#include <cmath>

#include "base/distributions.h"

namespace repose::calibrate {
namespace {

bool is_known(const SensitivityCheck& check) {
  return std::isfinite(check.change) && std::isfinite(check.interval.low) &&
         std::isfinite(check.interval.high);
}

/// What the study's grains would read where the bench's read `mean`: `change` is what makes them
/// more like the bench's, if it adds to a reading, and if it goes with it.
Interval without(double mean, double change) {
  const double added = mean - change;
  const bool can_go_with_it = mean > 0 && mean + change > 0;
  return {added, can_go_with_it ? mean * mean / (mean + change) : added};
}

/// One pair of readings does not tell which of both it is, nor what is between them: the middle,
/// and the standard deviation of what is anywhere in between (JCGM 100:2008, GUM, 4.3.7).
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
