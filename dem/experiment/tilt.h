#pragma once

#include "base/units.h"
#include "dem/engine/simulation.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// Where a plate stops to turn.
inline constexpr double kSteepest_deg = 89;
/// The onset comes out within .01 degrees up to here, and half a degree low at 50.
inline constexpr double kFastest_deg_s = 10;

/// Turned by an angle about y: what pointed along +x points down the slope.
Quaternion slope(double angle_deg);

/// Where a grain is in the frame of a wall, and how it is turned there.
Vector on_plate(const Simulation& simulation, int wall, int grain);
Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain);

/// `count` grains that touch, all turned the same way, as one rigid grain.
///
/// They stand in a row along their middle axis: in lying_pose() the row lies along x. Mass and
/// inertia are those of the grains' own surfaces, by the parallel axis theorem (Goldstein, Poole,
/// Safko 2002, Classical Mechanics, sec. 5.3): a row along one principal axis keeps the axes, and
/// adds the mean square distance from its middle to the other two. Proved by Bonded.* in
/// tests/dem/experiment_bonded_test.cpp. The surface is left empty.
ClumpShape bonded_shape(const ClumpShape& grain, int count);

}  // namespace repose::dem
