#pragma once

#include <span>

namespace repose::vision {

/// y = intercept + slope * x.
struct LineFit {
  double intercept = 0;
  double slope = 0;
  double r2 = 0;

  double y(double x) const { return intercept + slope * x; }
};

/// Ordinary least squares of y on x: the line that minimises the sum of squared vertical distances.
/// Needs two different x; else the slope is 0.
LineFit least_squares_line(std::span<const double> x, std::span<const double> y);

/// Line under Tukey's biweight loss (Ceres), started at the least-squares line: points farther than
/// about 4.7 robust standard deviations do not count. r2 is that of the start.
///
/// Scale: 1.4826 times the median absolute residual, of the start at first, then of each new line
/// until it settles: strays widen the start's.
/// Source: Huber & Ronchetti, Robust Statistics (2009), sec. 4.8 (biweight), 5.1 (median
/// deviation).
LineFit robust_line(std::span<const double> x, std::span<const double> y);

/// Median of a copy; NaN when empty.
double median(std::span<const double> values);

/// The median of absolute residuals times this is the standard deviation of a normal distribution.
inline constexpr double kMadToSigma = 1.4826;

}  // namespace repose::vision
