#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/units.h"

namespace repose::dem {

/// Positions, velocities, forces: SI units, z upwards unless said otherwise.
using Vector = Eigen::Vector3d;
/// Orientations: rotate from the body's own frame to the world's. Always of unit length.
using Quaternion = Eigen::Quaterniond;

}  // namespace repose::dem
