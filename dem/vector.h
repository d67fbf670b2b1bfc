#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace repose::dem {

/// Positions, velocities, forces: SI units, z upwards unless said otherwise.
using Vector = Eigen::Vector3d;
/// Orientations: rotate from a body's own frame to the world's. Always of unit length.
using Quaternion = Eigen::Quaterniond;

inline constexpr double kStandardGravity_m_s2 = 9.80665;

}  // namespace repose::dem
