#include "dem/experiment/hanging_pair.h"

#include <algorithm>
#include <cmath>

#include "dem/experiment/tilting_plate.h"

namespace repose::dem {
namespace {

/// How far apart along x the centres of two turned grains are that just touch.
double touching_distance_m(const ClumpShape& shape, const Quaternion& a, const Quaternion& b) {
  double distance = 0;
  for (const ClumpSphere& one : shape.spheres) {
    for (const ClumpSphere& other : shape.spheres) {
      const Vector apart = a * one.centre - b * other.centre;
      const double reach = one.radius + other.radius;
      const double chord2 = reach * reach - apart.y() * apart.y() - apart.z() * apart.z();
      if (chord2 > 0) distance = std::max(distance, apart.x() + std::sqrt(chord2));
    }
  }
  return distance;
}

}  // namespace

HangingPair hanging_pair(const ClumpShape& shape, Random& random) {
  HangingPair pair;
  pair.swinging = random.orientation();
  pair.hanging = random.orientation();
  pair.apart_m =
      touching_distance_m(shape, pair.swinging, pair.hanging) + kPendulumGap * shape.reach_m();
  return pair;
}

double release_height_m(const PendulumProtocol& protocol) {
  return protocol.string_m * (1 - std::cos(protocol.release_deg * kDegree));
}

double swing_speed_m_s(const PendulumProtocol& protocol) {
  return std::sqrt(2 * kStandardGravity_m_s2 * release_height_m(protocol));
}

}  // namespace repose::dem
