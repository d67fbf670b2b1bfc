#pragma once

#include <cstdint>
#include <span>

namespace repose::vision {

/// y = intercept + slope * x.
struct LineFit {
  double intercept = 0;
  double slope = 0;
  double r2 = 0;

  double y(double x) const { return intercept + slope * x; }
};

/// Least squares of y on x: the line that minimises the sum of squared vertical distances. Needs
/// two different x; otherwise the slope is 0.
/// @param weight  weight of each squared residual; empty: equal weights
LineFit least_squares_line(std::span<const double> x, std::span<const double> y,
                           std::span<const double> weight = {});

/// Line under Tukey's biweight loss (Ceres), started at the least-squares line: points farther than
/// about 4.7 robust standard deviations do not count. r2 is that of the starting line.
///
/// Scale: 1.4826 times the median absolute residual, first of the starting line, then of each new
/// line until it settles, as outliers inflate the first estimate.
/// Source: Huber & Ronchetti, Robust Statistics (2009), sec. 4.8 (biweight), 5.1 (median
/// deviation).
/// @param weight          as for least_squares_line()
/// @param smallest_scale  the scale does not fall below it
LineFit robust_line(std::span<const double> x, std::span<const double> y,
                    std::span<const double> weight = {}, double smallest_scale = 0);

/// Median of a copy; NaN when empty.
/// @param weight  weight of each value; empty: equal weights
double median(std::span<const double> values, std::span<const double> weight = {});

/// The median of absolute residuals times this is the standard deviation of a normal distribution.
inline constexpr double kMadToSigma = 1.4826;

/// Standard error of a line's slope when neighbouring residuals are correlated: one grain spans
/// dozens of edge points, so the plain formula is several times too small.
///
/// Moving-block bootstrap of the residuals: blocks of `block` neighbours are drawn with replacement
/// and the slope is refitted; the result is the standard deviation of those slopes times sqrt(b /
/// (b - 2)), where b is the number of independent blocks.
/// Source: Davison & Hinkley, Bootstrap Methods and their Application (1997), sec. 8.2.3.
/// Proved by tests/vision/bootstrap_test.cpp.
/// @param x  ascending positions; @param residual  same size
/// @param weight  as for least_squares_line()
double block_bootstrap_slope_error(std::span<const double> x, std::span<const double> residual,
                                   std::size_t block, std::uint64_t seed,
                                   std::span<const double> weight = {});

/// Number of independent blocks in n points; at least 4, so that an interval exists.
double independent_blocks(double points, std::size_t block);

}  // namespace repose::vision
