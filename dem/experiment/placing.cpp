#include "dem/experiment/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace repose::dem {

double reach_towards(const ClumpShape& shape, const Quaternion& orientation,
                     const Vector& direction) {
  const Vector own = orientation.conjugate() * direction;
  double reach = -std::numeric_limits<double>::infinity();
  for (const ClumpSphere& sphere : shape.spheres) {
    reach = std::max(reach, own.dot(sphere.centre) + sphere.radius);
  }
  return reach;
}

double lowest_m(const ClumpShape& shape, const Grain& grain) {
  return grain.position.z() - reach_towards(shape, grain.orientation, -Vector::UnitZ());
}

double highest_m(const ClumpShape& shape, const Grain& grain) {
  return grain.position.z() + reach_towards(shape, grain.orientation, Vector::UnitZ());
}

const ClumpShape& shape_of(const Simulation& simulation, const Grain& grain) {
  return simulation.setup().kinds[static_cast<std::size_t>(grain.kind)].shape;
}

double reach_m(const SimulationSetup& setup) {
  double reach = 0;
  for (const GrainKind& kind : setup.kinds) reach = std::max(reach, kind.shape.reach_m());
  return reach;
}

void Bulk::add(const Simulation& simulation, int grain) {
  const ClumpShape& mean = simulation.setup().kinds.front().shape;
  ++grains;
  relative_mass += shape_of(simulation, simulation.grain(grain)).volume_m3 / mean.volume_m3;
}

double highest_m(const Simulation& simulation, int grain) {
  const Grain now = simulation.grain(grain);
  return highest_m(shape_of(simulation, now), now);
}

Quaternion lying_pose(const ClumpShape& shape) {
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return shape.gyration_m2[a] < shape.gyration_m2[b]; });
  const Vector along_y = Vector::Unit(axes[0]);
  const Vector along_z = Vector::Unit(axes[2]);
  Eigen::Matrix3d own_axes;  // rows: what becomes x, y, z
  own_axes << along_y.cross(along_z).transpose(), along_y.transpose(), along_z.transpose();
  return Quaternion(own_axes).normalized();
}

double diameter_m(const ClumpShape& shape) {
  return std::cbrt(6 / std::numbers::pi * shape.volume_m3);
}

std::vector<ClumpSphere> placed_spheres(const Simulation& simulation) {
  std::vector<ClumpSphere> placed;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    const Grain grain = simulation.grain(k);
    for (const ClumpSphere& sphere : shape_of(simulation, grain).spheres) {
      placed.push_back(
          {.centre = grain.position + grain.orientation * sphere.centre, .radius = sphere.radius});
    }
  }
  return placed;
}

}  // namespace repose::dem
