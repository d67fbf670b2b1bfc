#pragma once

#include <span>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// Mean height of the upper surface of spheres in an upright tube about the z axis, m: of the
/// highest sphere on each of many plumb lines, spread evenly over the tube, or of the floor z = 0
/// where a line meets none. What a ruler gives that is put down on the grains at many places.
/// Proved by FillingHeight.* in tests/dem/experiment_fill_test.cpp.
double filling_height_m(std::span<const ClumpSphere> spheres, double tube_diameter_m);

}  // namespace repose::dem
