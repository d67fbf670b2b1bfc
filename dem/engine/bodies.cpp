#include "dem/engine/bodies.h"

#include <algorithm>
#include <array>

#include "dem/engine/parallel.h"

// Four bodies at a time.

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

namespace {

using Vectors = Vec3<Double4>;

struct Quaternions {
  Double4 x;
  Double4 y;
  Double4 z;
  Double4 w;
};

/// The body's axes in world coordinates.
struct Axes {
  Vectors x;
  Vectors y;
  Vectors z;

  REPOSE_INLINE Vectors to_world(const Vectors& v) const { return x * v.x + y * v.y + z * v.z; }
  REPOSE_INLINE Vectors to_body(const Vectors& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
};

REPOSE_INLINE Axes axes_of(const Quaternions& q) {
  const Double4 two_x = 2 * q.x;
  const Double4 two_y = 2 * q.y;
  const Double4 two_z = 2 * q.z;
  const Double4 xx = two_x * q.x;
  const Double4 yy = two_y * q.y;
  const Double4 zz = two_z * q.z;
  const Double4 xy = two_x * q.y;
  const Double4 xz = two_x * q.z;
  const Double4 yz = two_y * q.z;
  const Double4 wx = two_x * q.w;
  const Double4 wy = two_y * q.w;
  const Double4 wz = two_z * q.w;
  return {{1 - (yy + zz), xy + wz, xz - wy},
          {xy - wz, 1 - (xx + zz), yz + wx},
          {xz + wy, yz - wx, 1 - (xx + yy)}};
}

/// Rotates about the body's own axes by the Cayley map: by 2 atan(|turn| / 2) about `turn`.
REPOSE_INLINE Quaternions turned_by(const Quaternions& q, const Vectors& turn) {
  const Vectors half = turn * Double4(.5);
  const Quaternions r = {q.x + q.w * half.x + q.y * half.z - q.z * half.y,
                         q.y + q.w * half.y + q.z * half.x - q.x * half.z,
                         q.z + q.w * half.z + q.x * half.y - q.y * half.x,
                         q.w - q.x * half.x - q.y * half.y - q.z * half.z};
  const Double4 scale = 1 / sqrt(r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  return {r.x * scale, r.y * scale, r.z * scale, r.w * scale};
}

REPOSE_INLINE Vectors load_vectors(const VectorArray& field, std::size_t k) {
  return {load(field.coordinate(0) + k), load(field.coordinate(1) + k),
          load(field.coordinate(2) + k)};
}
REPOSE_INLINE void store_vectors(const Vectors& values, VectorArray& field, std::size_t k) {
  store(values.x, field.coordinate(0) + k);
  store(values.y, field.coordinate(1) + k);
  store(values.z, field.coordinate(2) + k);
}
REPOSE_INLINE Quaternions load_orientation(const Bodies& bodies, std::size_t k) {
  return {load(&bodies.orientation[0][k]), load(&bodies.orientation[1][k]),
          load(&bodies.orientation[2][k]), load(&bodies.orientation[3][k])};
}

REPOSE_INLINE Columns load_rows(const Row* first) {
  return columns_of(
      {{load_row(first[0]), load_row(first[1]), load_row(first[2]), load_row(first[3])}});
}

/// One row of each of four structures.
template <typename Structure>
REPOSE_INLINE Columns load_rows(const Structure* first, const Row Structure::*row) {
  return columns_of({{load_row(first[0].*row), load_row(first[1].*row), load_row(first[2].*row),
                      load_row(first[3].*row)}});
}
template <typename Structure>
REPOSE_INLINE void store_rows(const Vectors& xyz, const Double4& w, Structure* first,
                              Row Structure::*row) {
  const Rows rows = rows_of(xyz, w);
  for (std::size_t lane = 0; lane < kLanes; ++lane) store_row(rows.row[lane], first[lane].*row);
}

/// Half a step of torque, then of constant-torque rolling friction as a dry brake on the spin: it
/// removes at most the spin there is, so that a grain comes to rest instead of jittering.
struct SpinKick {
  Vectors momentum;
  Vectors own_momentum;  ///< in the body's own axes
};

REPOSE_INLINE SpinKick kick_spin(const Vectors& old_momentum, const Axes& axes,
                                 const Vectors& inverse_inertia, const Columns& torque,
                                 double half_timestep) {
  const Vectors pushed = old_momentum + torque.xyz * Double4(half_timestep);
  const Vectors own = axes.to_body(pushed);
  const Double4 brake = half_timestep * torque.w;
  if (!any(brake > Double4(0))) return {pushed, own};
  const Vectors spin = own.times(inverse_inertia);
  const Double4 size2 = spin.squared_norm();
  const Double4 size = sqrt(size2);
  // The brake slows the spin by brake (axis . I^-1 axis), axis = spin / |spin|.
  const auto stops = brake * spin.times(spin).dot(inverse_inertia) >= size2 * size;
  const Vectors braked = select(stops, Vectors{}, own - spin * Double4(brake / size));
  const auto is_braked = brake > Double4(0);
  return {select(is_braked, axes.to_world(braked), pushed), select(is_braked, braked, own)};
}

REPOSE_INLINE Vectors spin_by(const Vectors& momentum, const Axes& axes,
                              const Vectors& inverse_inertia) {
  return axes.to_world(axes.to_body(momentum).times(inverse_inertia));
}

REPOSE_INLINE void place_spheres(Bodies& bodies, std::size_t body, const ClumpShape& shape,
                                 const Double4& position, const Double4& x_axis,
                                 const Double4& y_axis, const Double4& z_axis) {
  auto* placed = &bodies.spheres[static_cast<std::size_t>(bodies.first_sphere[body])];
  const LaneMask is_radius = Double4(Double4::Vector4{0, 0, 0, 1}) > Double4(0);
  for (const ClumpSphere& sphere : shape.spheres) {
    const Double4 radius = select(is_radius, load_row(sphere), Double4(0));
    store_row(position + radius + x_axis * sphere.centre.x() + y_axis * sphere.centre.y() +
                  z_axis * sphere.centre.z(),
              *placed++);
  }
}

REPOSE_INLINE void place_centres(Bodies& bodies, std::size_t k, const Vectors& position) {
  const Rows positions = rows_of(position, Double4{});
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    store_row(positions.row[lane], bodies.position[k + lane]);
  }
  if (!bodies.is_round) return;
  const Rows placed = rows_of(position, load(&bodies.bounding_radius[k]));
  for (std::size_t lane = 0; lane < std::min(kLanes, bodies.size() - k); ++lane) {
    store_row(placed.row[lane], bodies.spheres[k + lane]);
  }
}

REPOSE_INLINE void place_clumps(Bodies& bodies, std::size_t k, const std::vector<GrainKind>& kinds,
                                const Axes& axes) {
  const Rows x_axes = rows_of(axes.x, Double4{});
  const Rows y_axes = rows_of(axes.y, Double4{});
  const Rows z_axes = rows_of(axes.z, Double4{});
  for (std::size_t lane = 0; lane < std::min(kLanes, bodies.size() - k); ++lane) {
    const std::size_t body = k + lane;
    if (!bodies.is_present(body)) continue;
    place_spheres(bodies, body, kinds[static_cast<std::size_t>(bodies.kind[body])].shape,
                  load_row(bodies.position[body]), x_axes.row[lane], y_axes.row[lane],
                  z_axes.row[lane]);
  }
}

/// Only for bodies present; the others keep their last loads.
REPOSE_INLINE void begin_loads(Bodies& bodies, std::size_t k, const Double4& mass,
                               const Vector& gravity) {
  const Rows weights = rows_of({mass * gravity.x(), mass * gravity.y(), mass * gravity.z()}, {});
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (!bodies.is_present(k + lane)) continue;
    store_row(weights.row[lane], bodies.load[k + lane].force);
    bodies.load[k + lane].torque = {};
  }
}

/// What four bodies carry from pass to pass of start_step().
struct FourKicks {
  Vectors own_momentum;     ///< angular, in the body's own axes
  Vectors momentum_change;  ///< angular
};

/// Half a step of force and torque, and the drift.
REPOSE_INLINE void kick_four(Bodies& bodies, std::size_t k, const Vector& gravity, double timestep,
                             FourKicks& kicks) {
  const double half = timestep / 2;
  const auto is_present = load(&bodies.presence[k]) > Double4(0);
  const Double4 mass = load(&bodies.mass[k]);
  const Vectors old_velocity = load_vectors(bodies.velocity, k);
  const Vectors old_position = load_rows(&bodies.position[k]).xyz;
  const Vectors old_momentum = load_vectors(bodies.angular_momentum, k);
  const Columns force = load_rows(&bodies.load[k], &BodyLoad::force);
  const Columns torque = load_rows(&bodies.load[k], &BodyLoad::torque);

  const Vectors velocity_kick = force.xyz * Double4(half / mass);
  const Vectors velocity = select(is_present, old_velocity + velocity_kick, old_velocity);
  const Vectors position =
      select(is_present, old_position + velocity * Double4(timestep), old_position);
  const SpinKick kick = kick_spin(old_momentum, axes_of(load_orientation(bodies, k)),
                                  load_vectors(bodies.inverse_inertia, k), torque, half);
  const Vectors momentum = select(is_present, kick.momentum, old_momentum);

  store_vectors(velocity, bodies.velocity, k);
  store_vectors(momentum, bodies.angular_momentum, k);
  store_rows(velocity, force.w, &bodies.motion[k], &BodyMotion::velocity);
  store_rows(velocity_kick, Double4{}, &bodies.motion[k], &BodyMotion::velocity_kick);
  begin_loads(bodies, k, mass, gravity);
  place_centres(bodies, k, position);
  kicks = {kick.own_momentum, momentum - old_momentum};
}

REPOSE_INLINE void turn_four(Bodies& bodies, std::size_t k, double timestep,
                             const Vectors& own_momentum) {
  const auto is_present = load(&bodies.presence[k]) > Double4(0);
  const Vectors inverse_inertia = load_vectors(bodies.inverse_inertia, k);
  const Quaternions old_q = load_orientation(bodies, k);
  // In the body frame the momentum rotates: dl/dt = l x omega (Euler), here by half a step.
  const Vectors middle = own_momentum + own_momentum.cross(own_momentum.times(inverse_inertia)) *
                                            Double4(timestep / 2);
  const Quaternions q = turned_by(old_q, middle.times(inverse_inertia) * Double4(timestep));
  store(select(is_present, q.x, old_q.x), &bodies.orientation[0][k]);
  store(select(is_present, q.y, old_q.y), &bodies.orientation[1][k]);
  store(select(is_present, q.z, old_q.z), &bodies.orientation[2][k]);
  store(select(is_present, q.w, old_q.w), &bodies.orientation[3][k]);
}

/// Stores what contacts need to know about spins, and places the spheres.
REPOSE_INLINE void show_four(Bodies& bodies, std::size_t k, const std::vector<GrainKind>& kinds,
                             const Vectors& momentum_change) {
  const Axes axes = axes_of(load_orientation(bodies, k));
  const Vectors inverse_inertia = load_vectors(bodies.inverse_inertia, k);
  const Double4 inertia = 1 / max(inverse_inertia.x, max(inverse_inertia.y, inverse_inertia.z));
  const Vectors momentum = load_vectors(bodies.angular_momentum, k);
  store_rows(spin_by(momentum, axes, inverse_inertia), load(&bodies.mass[k]), &bodies.motion[k],
             &BodyMotion::spin);
  store_rows(spin_by(momentum_change, axes, inverse_inertia), inertia, &bodies.motion[k],
             &BodyMotion::spin_kick);
  if (!bodies.is_round) place_clumps(bodies, k, kinds, axes);
}

/// Short passes let the processor overlap several fours; in one long pass each would stall on its
/// own square roots.
REPOSE_TARGET_CLONES void start_some(Bodies& bodies, const Chunk& fours,
                                     const std::vector<GrainKind>& kinds, const Vector& gravity,
                                     double timestep) {
  std::array<FourKicks, kBatchesPerBlock> kicks;
  for (std::size_t n = 0; n < fours.size(); ++n) {
    kick_four(bodies, kLanes * (fours.first + n), gravity, timestep, kicks[n]);
  }
  for (std::size_t n = 0; n < fours.size(); ++n) {
    turn_four(bodies, kLanes * (fours.first + n), timestep, kicks[n].own_momentum);
  }
  for (std::size_t n = 0; n < fours.size(); ++n) {
    show_four(bodies, kLanes * (fours.first + n), kinds, kicks[n].momentum_change);
  }
}

REPOSE_INLINE void finish_four(Bodies& bodies, std::size_t k, double timestep) {
  const double half = timestep / 2;
  const auto is_present = load(&bodies.presence[k]) > Double4(0);
  const Vectors velocity = load_vectors(bodies.velocity, k);
  const Vectors momentum = load_vectors(bodies.angular_momentum, k);
  const Columns force = load_rows(&bodies.load[k], &BodyLoad::force);
  const Columns torque = load_rows(&bodies.load[k], &BodyLoad::torque);
  const Vectors kicked = velocity + force.xyz * Double4(half / load(&bodies.mass[k]));
  const SpinKick kick = kick_spin(momentum, axes_of(load_orientation(bodies, k)),
                                  load_vectors(bodies.inverse_inertia, k), torque, half);
  store_vectors(select(is_present, kicked, velocity), bodies.velocity, k);
  store_vectors(select(is_present, kick.momentum, momentum), bodies.angular_momentum, k);
}

REPOSE_TARGET_CLONES void finish_some(Bodies& bodies, const Chunk& fours, double timestep) {
  for (std::size_t four = fours.first; four < fours.end; ++four) {
    finish_four(bodies, kLanes * four, timestep);
  }
}

}  // namespace

void start_step(Bodies& bodies, const std::vector<GrainKind>& kinds, const Vector& gravity,
                double timestep, int threads) {
  for_each_chunk(bodies.presence.size() / kLanes, kBatchesPerBlock, threads,
                 [&](const Chunk& fours) { start_some(bodies, fours, kinds, gravity, timestep); });
}

void finish_step(Bodies& bodies, double timestep, int threads) {
  for_each_chunk(bodies.presence.size() / kLanes, kBatchesPerBlock, threads,
                 [&](const Chunk& fours) { finish_some(bodies, fours, timestep); });
}

}  // namespace repose::dem
