#include "dem/engine/bodies.h"

namespace repose::dem {
namespace {

/// Makes room for four more.
void grow(Bodies& bodies) {
  const std::size_t size = bodies.presence.size() + kLanes;
  bodies.presence.resize(size, 0);
  bodies.mass.resize(size, 1);
  for (std::size_t k = 0; k < 4; ++k) bodies.orientation[k].resize(size, k == 3 ? 1 : 0);
  for (auto* field : {&bodies.inverse_inertia, &bodies.velocity, &bodies.angular_momentum}) {
    field->resize(size);
  }
  bodies.bounding_radius.resize(size, 0);
  bodies.position.resize(size);
  bodies.load.resize(size);
  bodies.motion.resize(size);
}

void set_motion(Bodies& bodies, std::size_t body) {
  bodies.motion[body] = {.velocity = {.xyz = bodies.velocity[body]},
                         .spin = {.xyz = bodies.spin_of(body), .w = bodies.mass[body]},
                         .velocity_kick = {},
                         .spin_kick = {.w = 1 / bodies.inverse_inertia[body].maxCoeff()}};
}

}  // namespace

void VectorArray::set(std::size_t k, const Vector& value) {
  for (int axis = 0; axis < 3; ++axis) xyz_[static_cast<std::size_t>(axis)][k] = value[axis];
}

void VectorArray::resize(std::size_t size) {
  for (auto& values : xyz_) values.resize(size, 0);
}

Quaternion Bodies::orientation_of(std::size_t body) const {
  return {orientation[3][body], orientation[0][body], orientation[1][body], orientation[2][body]};
}

Vector Bodies::spin_of(std::size_t body) const {
  const Eigen::Matrix3d axes = orientation_of(body).toRotationMatrix();
  const Vector own = axes.transpose() * angular_momentum[body];
  return axes * own.cwiseProduct(inverse_inertia[body]);
}

void add_body(Bodies& bodies, const Grain& grain, const GrainKind& kind, double density_kg_m3) {
  const std::size_t k = bodies.size();
  if (k == bodies.presence.size()) grow(bodies);
  const double mass = kind.shape.volume_m3 * density_kg_m3;
  const Vector moments = mass * kind.shape.gyration_m2;
  bodies.kind.push_back(grain.kind);
  bodies.material.push_back(kind.material);
  bodies.presence[k] = 1;
  bodies.mass[k] = mass;
  bodies.bounding_radius[k] = kind.shape.reach_m();
  bodies.inverse_inertia.set(k, moments.cwiseInverse());
  bodies.position[k].xyz = grain.position;
  for (std::size_t i = 0; i < 4; ++i) {
    bodies.orientation[i][k] = grain.orientation.coeffs()[static_cast<int>(i)];
  }
  bodies.velocity.set(k, grain.velocity);
  const Eigen::Matrix3d axes = grain.orientation.toRotationMatrix();
  const Vector own_spin = axes.transpose() * grain.spin;
  bodies.angular_momentum.set(k, axes * moments.cwiseProduct(own_spin));
  set_motion(bodies, k);
  bodies.is_round &= kind.shape.spheres.size() == 1 && kind.shape.spheres[0].centre.isZero(0);
  if (bodies.first_sphere.empty()) bodies.first_sphere.push_back(0);
  for (const ClumpSphere& sphere : kind.shape.spheres) {
    bodies.spheres.push_back(
        {.centre = grain.position + axes * sphere.centre, .radius = sphere.radius});
    bodies.sphere_body.push_back(static_cast<int>(k));
  }
  bodies.first_sphere.push_back(static_cast<int>(bodies.spheres.size()));
}

}  // namespace repose::dem
