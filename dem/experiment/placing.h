#pragma once

#include <vector>

#include "dem/engine/simulation.h"

namespace repose::dem {

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

}  // namespace repose::dem
