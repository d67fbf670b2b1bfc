#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// agrees: the difference is shown to be within the tolerance. disagrees: it is larger than chance
/// explains. cannot_tell: neither.
enum class AgreementVerdict { agrees, disagrees, cannot_tell };

/// A mean, or the difference of two, with its uncertainty and how well that is known.
struct UncertainMean {
  double value = 0;
  double uncertainty = 0;  ///< standard uncertainty; 0: exact
  double df = 0;           ///< degrees of freedom of the uncertainty; infinite: known
};

/// How a sum of squares is distributed: `scale` times a chi-square of `df`.
struct ScaledChiSquare {
  double scale = 1;
  double df = 0;
};

/// Probability that chance alone makes one experiment differ this much, over all its readings.
struct ExperimentChance {
  double chance = 1;
  int readings = 1;
};

/// With Welch and Satterthwaite's degrees of freedom: Welch (1947), Biometrika 34, 28.
UncertainMean difference_of(const UncertainMean& simulated, const UncertainMean& measured);

/// Adds an error of known standard deviation, which raises the degrees of freedom (Welch 1947).
UncertainMean with_known(const UncertainMean& mean, double sd);

/// The probability that chance alone makes a difference at least as large, two-sided.
double chance_of(const UncertainMean& difference);

/// The values that two one-sided tests at 5 % do not rule out (Schuirmann 1987, J. Pharmacokinet.
/// Biopharm. 15, 657). If they are within the tolerance, the means count as equal.
Interval equivalence_interval(const UncertainMean& difference);

/// The true difference that a test at `level` detects in four of five such checks.
double detectable_difference(const UncertainMean& difference, double level);

/// Number of runs that would decide, in four of five cases, between agreement and a difference
/// shown at `level`, if the true difference is the one found. std::nullopt if no number of runs
/// does, because the measured mean alone is too uncertain.
std::optional<int> runs_to_decide(const UncertainMean& difference, double measured_uncertainty,
                                  int runs, double tolerance, double level);

/// The probability that chance alone makes independent experiments differ as much as all of them
/// together do: Lancaster (1961), Aust. J. Stat. 3, 20. Each probability is converted to the
/// chi-square value that has it, with as many degrees of freedom as there are readings, whatever
/// distribution it came from; their sum is a chi-square too, or distributed as `sum` says.
double joint_chance(const std::vector<ExperimentChance>& experiments,
                    const std::optional<ScaledChiSquare>& sum = {});

/// Number of bench readings that would decide likewise. `by_scatter`: the standard uncertainty of
/// their mean from the scatter of `readings`. std::nullopt if no number does, because the rest is
/// too uncertain.
std::optional<int> readings_to_decide(const UncertainMean& difference, double by_scatter,
                                      int readings, double tolerance, double level);

/// Where a margin comes from: stated in the study, a fraction of the reading, a fraction of the
/// range that the bounds allow, or the one for angles.
enum class MarginSource { study, reading, range, angle };

/// How far bench and simulation may differ without it mattering. Fixed beforehand: the uncertainty
/// of the bench plays no part in it.
struct Margin {
  double value = 0;
  MarginSource source = MarginSource::reading;
};

/// What the study states; otherwise the smallest of 10 % of the measured value, 10 % of the range
/// that the bounds of the coefficients make `possible`, if known, and 2 degrees for angles.
/// Agreement within a larger part of the range would say next to nothing about the coefficients.
Margin margin_of(const Observable& observable, const std::optional<Interval>& possible);

}  // namespace repose::calibrate
