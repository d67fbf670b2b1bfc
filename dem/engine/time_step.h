#pragma once

#include "dem/engine/simulation.h"

namespace repose::dem {

// Longest steps, as fractions of the stable one, 2 / omega, by what is measured in the run. Each
// states its effect on restitution (Restitution.ComesOutAtEveryAcceptedTimestep). Tangential
// stiffness counts in omega whatever the friction: that makes the step short enough for both.

/// For measurements of single impacts: restitution within .0005 of the set value, elastic impacts
/// create less than 1e-4 of energy. The impact of a sphere on a wall takes 48 steps, of two equal
/// spheres 42.
inline constexpr double kImpactFraction = .07;
/// For sliding grains. Restitution within .002, 24 steps per impact, less than 1e-3 of energy
/// created (LongTimestep.*).
inline constexpr double kCourseFraction = .14;
/// For results of many impacts: how hundreds of grains fill, heap and flow out, and how far one
/// rolls. The mean restitution, over impacts that begin anywhere in a step, is within .002, a
/// single one within .012; 11 steps per impact, less than 6e-3 of energy created. Compared with
/// .14, angles of heaps agree within half a degree, rolling distances within .1 %
/// (dem/PERFORMANCE.md).
inline constexpr double kBulkFraction = .3;

/// The longest time step at which these grains are simulated accurately, s, for impacts with each
/// other and the walls at up to `speed_m_s`.
///
/// Source and limits: dem/THEORY.md, "Time step".
double accurate_timestep_s(const SimulationSetup& setup, double speed_m_s,
                           double fraction = kImpactFraction);

/// Throws base::InputError if `timestep_s` is longer than accurate_timestep_s, or less than a
/// thousandth of it.
void check_timestep(double timestep_s, const SimulationSetup& setup, double speed_m_s,
                    double fraction = kImpactFraction);

}  // namespace repose::dem
