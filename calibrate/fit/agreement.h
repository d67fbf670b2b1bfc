#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// agrees: the difference is shown to be within the tolerance. disagrees: it is more than chance
/// makes. cannot_tell: neither.
enum class AgreementVerdict { agrees, disagrees, cannot_tell };

/// A mean, or the difference of two, how uncertain it is, and by how many readings that is known.
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

/// That chance alone makes one experiment differ so much, in all of its readings together.
struct ExperimentChance {
  double chance = 1;
  int readings = 1;
};

/// With Welch and Satterthwaite's degrees of freedom: Welch (1947), Biometrika 34, 28.
UncertainMean difference_of(const UncertainMean& simulated, const UncertainMean& measured);

/// With a further error of known standard deviation: it makes the degrees of freedom more (Welch
/// 1947).
UncertainMean with_known(const UncertainMean& mean, double sd);

/// The probability that chance alone makes a difference as large, to either side.
double chance_of(const UncertainMean& difference);

/// The values that two one-sided tests at 5 % do not rule out (Schuirmann 1987, J. Pharmacokinet.
/// Biopharm. 15, 657): within the tolerance, both means are as good as equal.
Interval equivalence_interval(const UncertainMean& difference);

/// The true difference that a test at `level` sees in four of five such checks.
double detectable_difference(const UncertainMean& difference, double level);

/// How many runs would decide between agreement and a difference shown at `level`, in four of five
/// cases, were the true difference the one found. None: no number of runs does, as the measured
/// mean alone leaves too much open.
std::optional<int> runs_to_decide(const UncertainMean& difference, double measured_uncertainty,
                                  int runs, double tolerance, double level);

/// The probability that chance alone makes independent experiments differ as much as all of them
/// together do: Lancaster (1961), Aust. J. Stat. 3, 20. Each chance is turned into the chi-square
/// that has it, of as many degrees of freedom as it has readings, whatever distribution it came
/// from; their sum is a chi-square, too, or distributed as `sum` says.
double joint_chance(const std::vector<ExperimentChance>& experiments,
                    const std::optional<ScaledChiSquare>& sum = {});

/// How many readings of the bench would decide likewise, of whose mean `by_scatter` is the standard
/// uncertainty by the scatter of `readings`. None: no number does, as the rest leaves too much
/// open.
std::optional<int> readings_to_decide(const UncertainMean& difference, double by_scatter,
                                      int readings, double tolerance, double level);

/// Where a margin comes from: stated in the study, or a part of the reading or of the range that
/// the bounds allow, or that of angles.
enum class MarginSource { study, reading, range, angle };

/// What a difference of bench and simulation may be without mattering. It is fixed beforehand: how
/// sure the bench is plays no part in it.
struct Margin {
  double value = 0;
  MarginSource source = MarginSource::reading;
};

/// What the study states; else the least of 10 % of the measured value, 10 % of the range of what
/// the bounds of the coefficients make `possible`, where that is known, and 2 degrees for angles.
/// Agreement within more of the range would say next to nothing of the coefficients.
Margin margin_of(const Observable& observable, const std::optional<Interval>& possible);

}  // namespace repose::calibrate
