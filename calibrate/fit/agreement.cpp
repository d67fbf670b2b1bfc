#include "calibrate/fit/agreement.h"

#include <algorithm>
#include <cmath>

#include "base/distributions.h"

namespace repose::calibrate {
namespace {

constexpr double kKnown = 1e6;     // degrees of freedom: as good as normal
constexpr double kOneSided = .95;  // of each of the two tests of equivalence
constexpr double kPower = .8;      // four of five
constexpr double kMostRuns = 1e5;  // more is never
constexpr double kSmallestChance = 1e-300;
constexpr double kAngle_deg = 2;
constexpr double kFraction = .05;

double normal_quantile(double probability) { return base::student_t_quantile(probability, kKnown); }

}  // namespace

UncertainMean difference_of(const UncertainMean& simulated, const UncertainMean& measured) {
  const auto variance_of = [](const UncertainMean& mean) {
    return base::EstimatedVariance{mean.uncertainty * mean.uncertainty, mean.df};
  };
  return {simulated.value - measured.value, std::hypot(simulated.uncertainty, measured.uncertainty),
          std::min(base::df_of_sum(variance_of(simulated), variance_of(measured)), kKnown)};
}

double chance_of(const UncertainMean& difference) {
  if (difference.uncertainty <= 0) return difference.value == 0 ? 1 : kSmallestChance;
  const double t = std::abs(difference.value) / difference.uncertainty;
  return std::max(2 * base::student_t_above(t, difference.df), kSmallestChance);
}

Interval not_ruled_out(const UncertainMean& difference) {
  const double half = base::student_t_quantile(kOneSided, difference.df) * difference.uncertainty;
  return {difference.value - half, difference.value + half};
}

double detectable_difference(const UncertainMean& difference, double level) {
  return (base::student_t_quantile(1 - level / 2, difference.df) +
          base::student_t_quantile(kPower, difference.df)) *
         difference.uncertainty;
}

std::optional<int> runs_to_decide(const UncertainMean& difference, double measured_uncertainty,
                                  int runs, double tolerance, double level) {
  const double measured2 = measured_uncertainty * measured_uncertainty;
  const double run2 = (difference.uncertainty * difference.uncertainty - measured2) * runs;
  const double off = std::abs(difference.value);
  const bool may_agree = off < tolerance;
  const double room = may_agree ? tolerance - off : off;
  const double needed = normal_quantile(may_agree ? kOneSided : 1 - level / 2);
  const double allowed = room / (needed + normal_quantile(kPower));
  const double left2 = allowed * allowed - measured2;
  if (!(left2 > 0) || !(run2 > 0) || run2 / left2 > kMostRuns) return std::nullopt;
  return std::max(static_cast<int>(std::ceil(run2 / left2)), runs + 1);
}

double joint_chance(const std::vector<ExperimentChance>& experiments) {
  double sum = 0;
  int readings = 0;
  for (const ExperimentChance& one : experiments) {
    sum += base::chi_square_exceeded(std::max(one.chance, kSmallestChance), one.readings);
    readings += one.readings;
  }
  return base::chi_square_above(sum, readings);
}

double tolerance_of(const Observable& observable, double measured_uncertainty) {
  if (observable.tolerance) return *observable.tolerance;
  if (observable.unit == "deg") return kAngle_deg;
  const double fraction = kFraction * std::abs(observable.mean);
  if (!observable.sd) return fraction;  // a scatter that is only assumed allows nothing
  return std::max(fraction,
                  base::student_t_quantile(.975, observable.n - 1) * measured_uncertainty);
}

}  // namespace repose::calibrate
