#include "dem/experiment/bonded.h"

#include <algorithm>
#include <cmath>

#include "dem/experiment/placing.h"

namespace repose::dem {
namespace {

/// How far apart along `direction` (unit) two equal grains are that just touch.
double touching_distance_m(const ClumpShape& grain, const Vector& direction) {
  double distance = 0;
  for (const ClumpSphere& a : grain.spheres) {
    for (const ClumpSphere& b : grain.spheres) {
      const Vector apart = a.centre - b.centre;
      const double along = direction.dot(apart);
      const double aside2 = apart.squaredNorm() - along * along;
      const double reach = a.radius + b.radius;
      const double chord2 = reach * reach - aside2;
      if (chord2 > 0) distance = std::max(distance, along + std::sqrt(chord2));
    }
  }
  return distance;
}

}  // namespace

ClumpShape bonded_shape(const ClumpShape& grain, int count) {
  const Vector row = lying_pose(grain).conjugate() * Vector::UnitX();
  const double distance = touching_distance_m(grain, row);
  ClumpShape body;
  body.volume_m3 = count * grain.volume_m3;
  double mean_square = 0;
  for (int k = 0; k < count; ++k) {
    const double place = (k - .5 * (count - 1)) * distance;
    mean_square += place * place / count;
    for (const ClumpSphere& sphere : grain.spheres) {
      body.spheres.push_back({.centre = sphere.centre + place * row, .radius = sphere.radius});
    }
  }
  body.gyration_m2 = grain.gyration_m2 + mean_square * (Vector::Ones() - row.cwiseAbs2());
  return body;
}

}  // namespace repose::dem
