#pragma once

#include "dem/engine/simulation.h"

namespace repose::dem {

// How long a step may be, as a fraction of the stable one, 2 / omega, by what is read from the run.
// What that does to restitution is at each (Restitution.ComesOutAtEveryAcceptedTimestep).
// Tangential stiffness counts in omega whatever the friction: it is what makes the step short
// enough for both.

/// For readings of single impacts, each within .0005 of the restitution asked for: elastic impacts
/// make less than 1e-4 of energy. A sphere on a wall is resolved by 48 steps an impact, two equal
/// spheres by 42.
inline constexpr double kImpactFraction = .07;
/// For when a grain slides. Restitution within .002, 24 steps an impact, less than 1e-3 of energy
/// (LongTimestep.*).
inline constexpr double kCourseFraction = .14;
/// For what many impacts decide together: how hundreds of grains fill, heap and flow out, and how
/// far one rolls. The mean restitution of impacts that begin anywhere in a step is within .002, a
/// single one's within .012; 11 steps an impact, less than 6e-3 of energy. Heaps' angles are those
/// of .14 within half a degree, rolls as long within .1 % (dem/PERFORMANCE.md).
inline constexpr double kBulkFraction = .3;

/// The longest time step at which these grains are simulated accurately, s, when they strike each
/// other and the walls at up to `speed_m_s`.
///
/// Source and limits: dem/THEORY.md, "Time step".
double accurate_timestep_s(const SimulationSetup& setup, double speed_m_s,
                           double fraction = kImpactFraction);

/// Throws base::InputError when `timestep_s` is longer than accurate_timestep_s.
void check_timestep(double timestep_s, const SimulationSetup& setup, double speed_m_s,
                    double fraction = kImpactFraction);

}  // namespace repose::dem
