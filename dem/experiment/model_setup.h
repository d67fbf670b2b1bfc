#pragma once

#include <vector>

#include "base/input_error.h"
#include "base/random.h"
#include "dem/engine/simulation.h"
#include "dem/engine/time_step.h"
#include "dem/experiment/experiment.h"
#include "dem/vector.h"

namespace repose::dem {

/// Random numbers that are the same everywhere, and random rotations.
class Random : public base::Random {
 public:
  using base::Random::Random;

  /// Uniform over all rotations.
  ///
  /// Source: Shoemake (1992), Uniform random rotations, Graphics Gems III, p. 124: a point spread
  /// evenly over the unit sphere in four dimensions. Proved by Random.* in
  /// tests/dem/experiment_random_test.cpp.
  Quaternion orientation();
};

/// As many grains as one run may have: a hundred times what a bench needs, and what fits into the
/// memory of one machine.
inline constexpr int kMaxGrains = 100'000;

/// Grains of one run that must never meet.

/// From one to the next of grains that fall from a height and rebound.
inline double drop_spacing_m(double height_m, double reach_m) { return 8 * (height_m + reach_m); }

/// From one to the next of bodies that slide down a plate, side by side.
inline double lane_m(double body_reach_m) { return 20 * body_reach_m; }

/// How far a grain's spheres reach from its centre of mass in a direction (unit, world axes), m.
double reach_towards(const ClumpShape& shape, const Quaternion& orientation,
                     const Vector& direction);

/// Height of the lowest (highest) point of a grain's spheres, m.
double lowest_m(const ClumpShape& shape, const Grain& grain);
double highest_m(const ClumpShape& shape, const Grain& grain);

/// The shape of a grain of the simulation, and the height of its highest point, m.
const ClumpShape& shape_of(const Simulation& simulation, const Grain& grain);
double highest_m(const Simulation& simulation, int grain);

/// Some grains of a simulation: their number, and their mass by that of one of the mean size.
struct Bulk {
  int grains = 0;
  double relative_mass = 0;

  void add(const Simulation& simulation, int grain);
};

/// Farthest that a sphere of any of the kinds reaches from the grain's centre of mass, m.
double reach_m(const SimulationSetup& setup);

/// Turns a grain so that its long axis lies along y and its shortest upright.
///
/// The long axis is the one with the least moment of inertia, the shortest that with the greatest.
Quaternion lying_pose(const ClumpShape& shape);

/// Diameter of the sphere with the grain's volume, m.
double diameter_m(const ClumpShape& shape);

/// The spheres of all grains present, where they are.
std::vector<ClumpSphere> placed_spheres(const Simulation& simulation);

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
