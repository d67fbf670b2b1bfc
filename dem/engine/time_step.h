#pragma once

#include "dem/engine/simulation.h"

namespace repose::dem {

/// The longest time step at which these grains are simulated accurately, s, when they strike each
/// other and the walls at up to `speed_m_s`.
///
/// Source and limits: dem/THEORY.md, "Time step".
double accurate_timestep_s(const SimulationSetup& setup, double speed_m_s);

/// Throws std::invalid_argument when `timestep_s` is longer than accurate_timestep_s.
void check_timestep(double timestep_s, const SimulationSetup& setup, double speed_m_s);

}  // namespace repose::dem
