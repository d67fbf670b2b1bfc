#include "dem/experiment/free_flight.h"

#include <algorithm>
#include <cmath>

namespace repose::dem {
namespace {

constexpr double kLongestTurn = .1;

using Parts = Eigen::Vector4d;  // of a quaternion: x, y, z, w

/// How an orientation turns with a spin about the body's own axes.
Parts rate_of(const Quaternion& orientation, const Vector& own_spin) {
  return .5 * (orientation * Quaternion(0, own_spin.x(), own_spin.y(), own_spin.z())).coeffs();
}

}  // namespace

Grain after_flight(const Grain& grain, const ClumpShape& shape, const Vector& gravity_m_s2,
                   double time_s) {
  Grain after = grain;
  after.position += time_s * grain.velocity + .5 * time_s * time_s * gravity_m_s2;
  after.velocity += time_s * gravity_m_s2;

  // Angular momentum by mass.
  const Vector momentum =
      grain.orientation *
      (grain.orientation.conjugate() * grain.spin).cwiseProduct(shape.gyration_m2);
  const auto own_spin = [&](const Quaternion& orientation) -> Vector {
    return (orientation.conjugate() * momentum).cwiseQuotient(shape.gyration_m2);
  };
  const auto rate = [&](const Parts& parts) {
    const Quaternion orientation = Quaternion(parts).normalized();
    return rate_of(orientation, own_spin(orientation));
  };
  const double fastest = momentum.norm() / shape.gyration_m2.minCoeff();
  const double steps = std::max(1.0, std::ceil(fastest * time_s / kLongestTurn));
  const double step_s = time_s / steps;
  for (int k = 0; k < static_cast<int>(steps); ++k) {
    const Parts q = after.orientation.coeffs();
    const Parts a = rate(q);
    const Parts b = rate(q + .5 * step_s * a);
    const Parts c = rate(q + .5 * step_s * b);
    const Parts d = rate(q + step_s * c);
    after.orientation = Quaternion(Parts(q + step_s / 6 * (a + 2 * b + 2 * c + d))).normalized();
  }
  after.spin = after.orientation * own_spin(after.orientation);
  return after;
}

}  // namespace repose::dem
