#include "dem/engine/bodies.h"

#include <cmath>

namespace repose::dem {
namespace {

/// Turns by the rotation vector of 2 tan(angle / 2) / angle times `turn`: the Cayley map.
Quaternion turned(const Quaternion& orientation, const Vector& turn) {
  const Vector half = turn / 2;
  const Quaternion step(1, half.x(), half.y(), half.z());
  Quaternion result = step * orientation;
  result.normalize();
  return result;
}

bool is_isotropic(const Vector& moments) {
  return moments.x() == moments.y() && moments.y() == moments.z();
}

Vector spin_of(const Quaternion& orientation, const Vector& moments, const Vector& momentum) {
  const Eigen::Matrix3d axes = orientation.toRotationMatrix();
  const Vector own = axes.transpose() * momentum;
  return axes * own.cwiseQuotient(moments);
}

/// Half a step of torque, then of constant-torque rolling friction as a dry brake on the spin: it
/// takes at most what there is, so that a grain comes to rest instead of trembling.
void kick_spin(Bodies& bodies, std::size_t body, double half_timestep) {
  Vector& momentum = bodies.angular_momentum[body];
  momentum += half_timestep * bodies.torque[body];
  const double brake = half_timestep * bodies.rolling_limit[body];
  if (brake <= 0) return;
  const Vector moments = bodies.mass[body] * bodies.gyration[body];
  const Vector spin = spin_of(bodies.orientation[body], moments, momentum);
  const double size = spin.norm();
  if (size == 0) return;
  const Vector axis = spin / size;
  if (brake * axis.dot(spin_of(bodies.orientation[body], moments, axis)) >= size) {
    momentum.setZero();
  } else {
    momentum -= brake * axis;
  }
}

}  // namespace

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3) {
  const double mass = kind.shape.volume_m3 * density_kg_m3;
  bodies.kind.push_back(grain.kind);
  bodies.present.push_back(1);
  bodies.mass.push_back(mass);
  bodies.gyration.push_back(kind.shape.gyration_m2);
  bodies.reach.push_back(kind.shape.reach_m());
  bodies.position.push_back(grain.position);
  bodies.orientation.push_back(grain.orientation);
  bodies.velocity.push_back(grain.velocity);
  const Eigen::Matrix3d axes = bodies.orientation.back().toRotationMatrix();
  const Vector own_spin = axes.transpose() * grain.spin;
  bodies.angular_momentum.emplace_back(axes *
                                       (mass * kind.shape.gyration_m2).cwiseProduct(own_spin));
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
  const Vector& position = bodies.position[body];
  auto* placed = &bodies.spheres[static_cast<std::size_t>(bodies.first_sphere[body])];
  const Eigen::Matrix3d axes = bodies.orientation[body].toRotationMatrix();
  for (const ClumpSphere& sphere : shape.spheres) {
    (placed++)->centre = position + axes * sphere.centre;
  }
  const Vector moments = bodies.mass[body] * bodies.gyration[body];
  if (is_isotropic(moments)) {
    const double inverse = 1 / moments.x();
    bodies.spin[body] = inverse * bodies.angular_momentum[body];
    bodies.spin_kick[body] *= inverse;
    return;
  }
  const auto spin_by = [&](const Vector& momentum) -> Vector {
    const Vector own = axes.transpose() * momentum;
    return axes * own.cwiseQuotient(moments);
  };
  bodies.spin[body] = spin_by(bodies.angular_momentum[body]);
  bodies.spin_kick[body] = spin_by(bodies.spin_kick[body]);
}

void start_step(Bodies& bodies, std::size_t body, const ClumpShape& shape, double timestep) {
  const double half = timestep / 2;
  bodies.velocity_kick[body] = bodies.force[body] * (half / bodies.mass[body]);
  bodies.velocity[body] += bodies.velocity_kick[body];
  bodies.position[body] += timestep * bodies.velocity[body];

  Vector& momentum = bodies.angular_momentum[body];
  const Vector before = momentum;
  kick_spin(bodies, body, half);
  bodies.spin_kick[body] = momentum - before;
  Quaternion& orientation = bodies.orientation[body];
  const Vector moments = bodies.mass[body] * bodies.gyration[body];
  if (is_isotropic(moments)) {
    orientation = turned(orientation, momentum * (timestep / moments.x()));
  } else {
    const Vector start = spin_of(orientation, moments, momentum);
    const Quaternion middle = turned(orientation, half * start);
    orientation = turned(orientation, timestep * spin_of(middle, moments, momentum));
  }
  place_spheres(bodies, body, shape);
}

void finish_step(Bodies& bodies, std::size_t body, double timestep) {
  const double half = timestep / 2;
  bodies.velocity[body] += bodies.force[body] * (half / bodies.mass[body]);
  kick_spin(bodies, body, half);
}

}  // namespace repose::dem
