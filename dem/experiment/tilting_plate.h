#pragma once

#include <numbers>

#include "dem/engine/simulation.h"

namespace repose::dem {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Turned by an angle about y: what pointed along +x points down the slope.
Quaternion slope(double angle_deg);

/// Where a grain is in the frame of a wall, and how it is turned there.
Vector on_plate(const Simulation& simulation, int wall, int grain);
Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain);

}  // namespace repose::dem
