#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// The shape, all its lengths multiplied by a factor above 0.
ClumpShape scaled(const ClumpShape& shape, double factor);

/// Grains of one shape whose sizes vary: equally frequent sizes, the mean first.
///
/// Sizes are normally distributed by number, with the standard deviation `sd_fraction` of the mean.
/// Each of nine sizes stands for a ninth of the grains: it is the median of that ninth, moved from
/// the mean by as much more (7 %) as gives all nine exactly that deviation. The smallest is then
/// 1.71 deviations below the mean. Without variation there is the mean alone.
/// Valid up to kMaxSizeSd; proved by SizeClasses.* in tests/dem/grain_sizes_test.cpp.
std::vector<ClumpShape> size_classes(const ClumpShape& mean, double sd_fraction);

/// Of `sd_fraction`: grains that vary more are hardly normally distributed.
inline constexpr double kMaxSizeSd = .2;

}  // namespace repose::dem
