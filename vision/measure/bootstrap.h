#pragma once

#include <cstdint>
#include <span>

namespace repose::vision {

/// Standard error of a line's slope when neighbouring residuals belong together: one grain is
/// dozens of edge points, so the plain formula is several times too small.
///
/// Moving-block bootstrap of the residuals: blocks of `block` neighbours are drawn with replacement
/// and the slope is refitted; the standard deviation of those slopes, times sqrt(b / (b - 2)) for
/// the b independent blocks there are.
/// Source: Davison & Hinkley, Bootstrap Methods and their Application (1997), sec. 8.2.3.
/// Proved by tests/vision/bootstrap_test.cpp.
/// @param x  ascending positions; @param residual  same size; points with weight 0 do not count.
double block_bootstrap_slope_error(std::span<const double> x, std::span<const double> residual,
                                   std::size_t block, std::uint64_t seed);

/// How many independent blocks n points make; at least 4, so that an interval exists.
double independent_blocks(std::size_t points, std::size_t block);

}  // namespace repose::vision
