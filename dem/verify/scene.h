#pragma once

#include "base/units.h"
#include "dem/engine/simulation.h"

namespace repose::dem {

class Trial;

/// Grains of one kind (material 0) and a wall's material (1), the same coefficients for all pairs.
/// No walls and no gravity yet.
SimulationSetup scene_of(const ClumpShape& shape, const Material& grain, const Material& wall,
                         const PairCoefficients& pair, RollingModel rolling = RollingModel::none,
                         DampingModel damping = DampingModel::per_contact);

inline constexpr double kBallRadius_m = .01;
/// The ball of the cases about sliding and rolling, soft so that steps are long, on its own kind.
SimulationSetup ball_scene(const PairCoefficients& pair, RollingModel rolling = RollingModel::none);

/// A block with a sphere in each corner that just touches its three faces; mass and inertia of the
/// block.
ClumpShape block_shape(const Vector& half_size, double sphere_radius);

/// Material 1; falls towards +x by `tilt`.
Wall tilted_plane(double tilt_rad);

/// A sphere that rests on tilted_plane: overlapping by what its weight asks for, at the origin.
Grain resting_sphere(const SimulationSetup& setup, double tilt_rad);

/// Down the slope of tilted_plane.
Vector downhill(double tilt_rad);

/// What happened while grain 0 touched something.
struct Collision {
  Grain after;
  double deepest_m = 0;
  double peak_n = 0;  ///< greatest push along `away`
  double pull_n = 0;  ///< greatest pull; 0 when it never pulled
  double duration_s = 0;
};

/// Follows a collision until grain 0, which comes near, touches nothing any more. Without gravity.
///
/// Peaks and duration are interpolated between steps. `away` is the unit vector from what is struck
/// to grain 0, `radius` that of the smaller sphere.
Collision collide(Simulation& simulation, const Vector& away, double radius);

/// Throws a sphere at a flat wall, from where it all but touches: from (0, 0, r) at the wall z = 0.
Collision strike_wall(Trial& trial, SimulationSetup setup, const Vector& velocity,
                      const Vector& spin = Vector::Zero());

}  // namespace repose::dem
