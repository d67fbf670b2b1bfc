#pragma once

#include "base/units.h"
#include "dem/engine/simulation.h"

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

}  // namespace repose::dem
