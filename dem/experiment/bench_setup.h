#pragma once

#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/experiment/faults.h"

namespace repose::dem {

/// The materials of every experiment's contact table.
inline constexpr int kGrainMaterial = 0;
inline constexpr int kWallMaterial = 1;

/// Notes what is wrong with the bench itself.
void find_faults(const Bench& bench, Faults& faults);

/// A wall of the bench's wall material, at rest.
Wall bench_wall(WallShape shape, const Pose& pose = {});

/// Grains of one shape among walls, with the bench's materials and a time step for impacts at up to
/// `speed_m_s`: the bench's own, or the bench's fraction times `timestep_share` of the longest
/// accurate one. Throws std::invalid_argument for a time step asked for that is not safe.
SimulationSetup bench_setup(const Bench& bench, const ClumpShape& shape, std::vector<Wall> walls,
                            double speed_m_s, double timestep_share = 1);

}  // namespace repose::dem
