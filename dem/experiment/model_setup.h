#pragma once

#include <vector>

#include "base/input_error.h"
#include "base/random.h"
#include "dem/engine/simulation.h"
#include "dem/engine/time_step.h"
#include "dem/experiment/experiment.h"
#include "dem/vector.h"

namespace repose::dem {

/// Random numbers that are the same on every platform, and random rotations.
class Random : public base::Random {
 public:
  using base::Random::Random;

  /// Uniform over all rotations.
  ///
  /// Source: Shoemake (1992), Uniform random rotations, Graphics Gems III, p. 124: a uniformly
  /// distributed point on the unit sphere in four dimensions. Proved by Random.* in
  /// tests/dem/experiment_random_test.cpp.
  Quaternion orientation();
};

/// Maximum number of grains in a run: a hundred times what an experiment needs, and still fits into
/// memory.
inline constexpr int kMaxGrains = 100'000;

/// Spacing of grains of one run that must never meet.

/// Between grains that fall from a height and rebound.
inline double drop_spacing_m(double height_m, double reach_m) { return 8 * (height_m + reach_m); }

/// Between bodies that slide down a plate, side by side.
inline double lane_m(double body_reach_m) { return 20 * body_reach_m; }

/// Extent of a grain's spheres from its centre of mass in a direction (unit, world axes), m.
double reach_towards(const ClumpShape& shape, const Quaternion& orientation,
                     const Vector& direction);

/// Height of the lowest (highest) point of a grain's spheres, m.
double lowest_m(const ClumpShape& shape, const Grain& grain);
double highest_m(const ClumpShape& shape, const Grain& grain);

/// The shape of a grain of the simulation, and the height of its highest point, m.
const ClumpShape& shape_of(const Simulation& simulation, const Grain& grain);
double highest_m(const Simulation& simulation, int grain);

/// Some grains of a simulation: their number, and their mass relative to a grain of mean size.
struct Bulk {
  int grains = 0;
  double relative_mass = 0;

  void add(const Simulation& simulation, int grain);
};

/// Largest extent of any of the kinds from the centre of mass, m.
double reach_m(const SimulationSetup& setup);

/// Rotation that lays a grain's long axis along y and its shortest axis vertical.
///
/// The long axis has the smallest moment of inertia, the shortest the largest.
Quaternion lying_pose(const ClumpShape& shape);

/// Diameter of the sphere with the grain's volume, m.
double diameter_m(const ClumpShape& shape);

/// The spheres of all grains present, at their current positions.
std::vector<ClumpSphere> placed_spheres(const Simulation& simulation);

/// The materials of every experiment's contact table; those of `Model::parts` follow.
inline constexpr int kGrainMaterial = 0;
inline constexpr int kWallMaterial = 1;

/// Adds all errors of the model itself.
void find_errors(const Model& model, base::Faults& errors);

/// A wall of the plate's material, at rest.
Wall study_wall(WallShape shape, const Pose& pose = {});

/// Material index of a part: the plate's if it has none of its own.
int material_of(const Model& model, WallPart part);
/// A wall of that part's material, at rest.
Wall part_wall(const Model& model, WallPart part, WallShape shape, const Pose& pose = {});

/// Grains of one shape among walls, with the model's materials and a time step for impacts at up to
/// `speed_m_s`: the model's own, or its timestep_fraction of the longest accurate one, which is
/// `fraction` of the stable one (time_step.h). Throws base::InputError if the model's own time step
/// is not safe.
SimulationSetup model_setup(const Model& model, const ClumpShape& shape, std::vector<Wall> walls,
                            double speed_m_s, double fraction = kImpactFraction);

/// Likewise for bulks: grains of all the model's sizes, the mean size as first kind, with
/// kBulkFraction.
SimulationSetup bulk_setup(const Model& model, std::vector<Wall> walls, double speed_m_s);

/// Largest extent of the largest of the model's grains from its centre of mass, m.
double largest_reach_m(const Model& model);

}  // namespace repose::dem
