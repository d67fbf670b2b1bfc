#pragma once

#include <vector>

#include "base/input_error.h"
#include "dem/engine/time_step.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// The materials of every experiment's contact table; those of `Model::parts` follow.
inline constexpr int kGrainMaterial = 0;
inline constexpr int kWallMaterial = 1;

/// Notes what is wrong with the bench itself.
void find_errors(const Model& model, base::Faults& errors);

/// A wall of the plate's material, at rest.
Wall study_wall(WallShape shape, const Pose& pose = {});

/// A part's number among the materials: the plate's where it has none of its own.
int material_of(const Model& model, WallPart part);
/// A wall that is such a part, at rest.
Wall part_wall(const Model& model, WallPart part, WallShape shape, const Pose& pose = {});

/// Grains of one shape among walls, with the bench's materials and a time step for impacts at up to
/// `speed_m_s`: the bench's own, or its share of the longest accurate one, `fraction` of the stable
/// one (time_step.h). Throws base::InputError for a time step asked for that is not safe.
SimulationSetup model_setup(const Model& model, const ClumpShape& shape, std::vector<Wall> walls,
                            double speed_m_s, double fraction = kImpactFraction);

/// Likewise of bulks: grains of all the model's sizes, the mean the first kind, and the usual
/// fraction of bulks (kBulkFraction).
SimulationSetup bulk_setup(const Model& model, std::vector<Wall> walls, double speed_m_s);

/// Farthest that a sphere of the largest of these grains reaches from its centre of mass, m.
double largest_reach_m(const Model& model);

}  // namespace repose::dem
