#include "calibrate/fit/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/distributions.h"

namespace repose::calibrate {
namespace {

constexpr double kOneSided = .95;  // of each of the two tests of equivalence
constexpr double kPower = .8;      // four of five checks
constexpr double kMaxRuns = 1e5;   // a larger number counts as none
constexpr double kSmallestChance = 1e-300;
constexpr double kAngle_deg = 2;
constexpr double kFraction = .1;  // of a reading, and of its possible range

double normal_quantile(double probability) {
  return base::student_t_quantile(probability, base::kManyDf);
}

}  // namespace

UncertainMean difference_of(const UncertainMean& simulated, const UncertainMean& measured) {
  const auto variance_of = [](const UncertainMean& mean) {
    return base::EstimatedVariance{mean.uncertainty * mean.uncertainty, mean.df};
  };
  return {simulated.value - measured.value, std::hypot(simulated.uncertainty, measured.uncertainty),
          std::min(base::df_of_sum(variance_of(simulated), variance_of(measured)), base::kManyDf)};
}

UncertainMean with_known(const UncertainMean& mean, double sd) {
  if (!(sd > 0)) return mean;
  const double uncertainty = std::hypot(mean.uncertainty, sd);
  if (!(mean.uncertainty > 0)) {
    return {mean.value, uncertainty, std::numeric_limits<double>::infinity()};
  }
  return {mean.value, uncertainty, mean.df * std::pow(uncertainty / mean.uncertainty, 4)};
}

double chance_of(const UncertainMean& difference) {
  if (difference.uncertainty <= 0) return difference.value == 0 ? 1 : kSmallestChance;
  const double t = std::abs(difference.value) / difference.uncertainty;
  return std::max(2 * base::student_t_above(t, difference.df), kSmallestChance);
}

Interval equivalence_interval(const UncertainMean& difference) {
  const double half = base::student_t_quantile(kOneSided, difference.df) * difference.uncertainty;
  return {difference.value - half, difference.value + half};
}

double detectable_difference(const UncertainMean& difference, double level) {
  return (base::student_t_quantile(1 - level / 2, difference.df) +
          base::student_t_quantile(kPower, difference.df)) *
         difference.uncertainty;
}

namespace {

/// Largest variance of a difference at which four of five checks decide.
double deciding_variance(const UncertainMean& difference, double tolerance, double level) {
  const double off = std::abs(difference.value);
  const bool may_agree = off < tolerance;
  const double room = may_agree ? tolerance - off : off;
  const double needed = normal_quantile(may_agree ? kOneSided : 1 - level / 2);
  const double allowed = room / (needed + normal_quantile(kPower));
  return allowed * allowed;
}

/// How many of them reduce the variance of their mean to `allowed`; more than the present number.
std::optional<int> number_for(double variance, double allowed, int now) {
  if (!(allowed > 0) || !(variance > 0) || variance / allowed > kMaxRuns) return std::nullopt;
  return std::max(static_cast<int>(std::ceil(variance / allowed)), now + 1);
}

}  // namespace

std::optional<int> runs_to_decide(const UncertainMean& difference, double measured_uncertainty,
                                  int runs, double tolerance, double level) {
  const double measured2 = measured_uncertainty * measured_uncertainty;
  const double run2 = (difference.uncertainty * difference.uncertainty - measured2) * runs;
  return number_for(run2, deciding_variance(difference, tolerance, level) - measured2, runs);
}

std::optional<int> readings_to_decide(const UncertainMean& difference, double by_scatter,
                                      int readings, double tolerance, double level) {
  const double scatter2 = by_scatter * by_scatter;
  const double rest2 = difference.uncertainty * difference.uncertainty - scatter2;
  return number_for(scatter2 * readings,
                    deciding_variance(difference, tolerance, level) - std::max(rest2, 0.),
                    readings);
}

double joint_chance(const std::vector<ExperimentChance>& experiments,
                    const std::optional<ScaledChiSquare>& sum) {
  double squares = 0;
  int readings = 0;
  for (const ExperimentChance& one : experiments) {
    squares += base::chi_square_exceeded(std::max(one.chance, kSmallestChance), one.readings);
    readings += one.readings;
  }
  if (!sum) return base::chi_square_above(squares, readings);
  return base::chi_square_above(squares / sum->scale, sum->df);
}

Margin margin_of(const Observable& observable, const std::optional<Interval>& possible) {
  if (observable.tolerance) return {*observable.tolerance, MarginSource::study};
  Margin least{kFraction * std::abs(observable.mean), MarginSource::reading};
  const auto consider = [&](double value, MarginSource source) {
    if (value < least.value) least = {value, source};
  };
  if (possible) consider(kFraction * (possible->high - possible->low), MarginSource::range);
  if (observable.unit == "deg") consider(kAngle_deg, MarginSource::angle);
  return least;
}

}  // namespace repose::calibrate
