#include "dem/engine/bodies.h"

#include <cmath>

namespace repose::dem {
namespace {

/// Turns about the body's own axes by Cayley's map: by 2 atan(|turn| / 2) about `turn`.
Quaternion turned(const Quaternion& orientation, const Vector& turn) {
  const Quaternion step(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  Quaternion result = orientation * step;
  result.coeffs() /= result.norm();
  return result;
}

/// Half a step of torque, then of constant-torque rolling friction as a dry brake on the spin: it
/// takes at most what there is, so that a grain comes to rest instead of trembling.
/// @return the angular momentum in the body's own axes
Vector kick_spin(Bodies& bodies, std::size_t body, double half_timestep) {
  Vector& momentum = bodies.angular_momentum[body];
  const Eigen::Matrix3d& axes = bodies.axes[body];
  momentum += half_timestep * bodies.torque[body];
  Vector own = axes.transpose() * momentum;
  const double brake = half_timestep * bodies.rolling_limit[body];
  if (brake <= 0) return own;
  const Vector spin = own.cwiseProduct(bodies.mobility[body]);
  const double size2 = spin.squaredNorm();
  // The brake slows the spin by brake (axis . I^-1 axis), axis = spin / |spin|.
  if (brake * spin.cwiseAbs2().dot(bodies.mobility[body]) >= size2 * std::sqrt(size2)) {
    own.setZero();
  } else {
    own -= (brake / std::sqrt(size2)) * spin;
  }
  momentum = axes * own;
  return own;
}

}  // namespace

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3) {
  const double mass = kind.shape.volume_m3 * density_kg_m3;
  bodies.kind.push_back(grain.kind);
  bodies.present.push_back(1);
  bodies.mass.push_back(mass);
  bodies.moments.emplace_back(mass * kind.shape.gyration_m2);
  bodies.mobility.emplace_back(bodies.moments.back().cwiseInverse());
  bodies.reach.push_back(kind.shape.reach_m());
  bodies.position.push_back(grain.position);
  bodies.orientation.push_back(grain.orientation);
  bodies.axes.push_back(grain.orientation.toRotationMatrix());
  bodies.velocity.push_back(grain.velocity);
  const Eigen::Matrix3d& axes = bodies.axes.back();
  const Vector own_spin = axes.transpose() * grain.spin;
  bodies.angular_momentum.emplace_back(axes * bodies.moments.back().cwiseProduct(own_spin));
  for (auto* field :
       {&bodies.force, &bodies.torque, &bodies.spin, &bodies.velocity_kick, &bodies.spin_kick}) {
    field->push_back(Vector::Zero());
  }
  bodies.rolling_limit.push_back(0);
  if (bodies.first_sphere.empty()) bodies.first_sphere.push_back(0);
  const int number = static_cast<int>(bodies.size()) - 1;
  for (const ClumpSphere& sphere : kind.shape.spheres) {
    bodies.spheres.push_back({.centre = grain.position, .radius = sphere.radius});
    bodies.sphere_body.push_back(number);
  }
  bodies.first_sphere.push_back(static_cast<int>(bodies.spheres.size()));
  place_spheres(bodies, bodies.size() - 1, kind.shape);
}

void place_spheres(Bodies& bodies, std::size_t body, const ClumpShape& shape) {
  const Eigen::Matrix3d axes = bodies.orientation[body].toRotationMatrix();
  bodies.axes[body] = axes;
  const Vector position = bodies.position[body];
  auto* placed = &bodies.spheres[static_cast<std::size_t>(bodies.first_sphere[body])];
  for (const ClumpSphere& sphere : shape.spheres) {
    (placed++)->centre = position + axes * sphere.centre;
  }
  const auto spin_by = [&](const Vector& momentum) -> Vector {
    const Vector own = axes.transpose() * momentum;
    return axes * own.cwiseProduct(bodies.mobility[body]);
  };
  bodies.spin[body] = spin_by(bodies.angular_momentum[body]);
  bodies.spin_kick[body] = spin_by(bodies.spin_kick[body]);
}

void start_step(Bodies& bodies, std::size_t body, const ClumpShape& shape, const Vector& gravity,
                double timestep) {
  const double half = timestep / 2;
  bodies.velocity_kick[body] = bodies.force[body] * (half / bodies.mass[body]);
  bodies.velocity[body] += bodies.velocity_kick[body];
  bodies.position[body] += timestep * bodies.velocity[body];

  const Vector before = bodies.angular_momentum[body];
  const Vector own = kick_spin(bodies, body, half);
  bodies.spin_kick[body] = bodies.angular_momentum[body] - before;
  // Seen from the body the momentum turns: dl/dt = l x omega (Euler), here by half a step.
  const Vector& mobility = bodies.mobility[body];
  const Vector middle = own + half * own.cross(own.cwiseProduct(mobility));
  bodies.orientation[body] =
      turned(bodies.orientation[body], timestep * middle.cwiseProduct(mobility));
  place_spheres(bodies, body, shape);

  bodies.force[body] = bodies.mass[body] * gravity;
  bodies.torque[body].setZero();
  bodies.rolling_limit[body] = 0;
}

void finish_step(Bodies& bodies, std::size_t body, double timestep) {
  const double half = timestep / 2;
  bodies.velocity[body] += bodies.force[body] * (half / bodies.mass[body]);
  kick_spin(bodies, body, half);
}

}  // namespace repose::dem
