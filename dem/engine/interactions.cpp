#include "dem/engine/interactions.h"

#include "dem/engine/contact_force.h"
#include "dem/engine/parallel.h"
#include "dem/engine/rolling.h"

namespace repose::dem {
namespace {

double reduced(double x, double y) { return x * y / (x + y); }

/// Least moment about a point `arm` away from the centre of mass.
double inertia_about(const Bodies& bodies, std::size_t k, double arm) {
  return bodies.mass[k] * (bodies.gyration[k].minCoeff() + arm * arm);
}

Vector velocity_at(const Bodies& bodies, std::size_t k, const Vector& arm) {
  return bodies.velocity[k] + bodies.spin[k].cross(arm);
}

Vector kick_at(const Bodies& bodies, std::size_t k, const Vector& arm) {
  return bodies.velocity_kick[k] + bodies.spin_kick[k].cross(arm);
}

void add_to_a(Bodies& bodies, const NearGrains& pair, const PairLoad& load) {
  const auto k = static_cast<std::size_t>(pair.a);
  bodies.force[k] += load.force;
  bodies.torque[k] += load.torque_a;
  bodies.rolling_limit[k] += load.rolling_a;
}

void add_to_b(Bodies& bodies, const NearGrains& pair, const PairLoad& load) {
  const auto k = static_cast<std::size_t>(pair.b);
  bodies.force[k] -= load.force;
  bodies.torque[k] += load.torque_b;
  bodies.rolling_limit[k] += load.rolling_b;
}

void note_overlap(double share, int body, ContactTally& tally) {
  if (share <= tally.deepest_overlap) return;
  tally.deepest_overlap = share;
  tally.deepest_body = body;
}

}  // namespace

int ContactStep::material(int body) const {
  const int kind = bodies.kind[static_cast<std::size_t>(body)];
  return kinds[static_cast<std::size_t>(kind)].material;
}

PairLoad ContactStep::load(const NearGrains& pair, NeighbourList& list) const {
  PairLoad load;
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  const ContactLaw* law = nullptr;
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const PlacedSphere& sphere_a = bodies.spheres[static_cast<std::size_t>(list.spheres[at].a)];
    const PlacedSphere& sphere_b = bodies.spheres[static_cast<std::size_t>(list.spheres[at].b)];
    const Vector apart = sphere_b.centre - sphere_a.centre;
    const double reach = sphere_a.radius + sphere_b.radius;
    const double distance2 = apart.squaredNorm();
    ContactMemory& memory = list.memories[at];
    if (distance2 >= reach * reach || distance2 == 0) {
      if (memory.radius > 0) memory = {};
      continue;
    }
    if (!law) law = &contacts.law(material(pair.a), material(pair.b));
    const double distance = std::sqrt(distance2);
    Touch touch;
    touch.normal = apart / distance;
    touch.overlap = reach - distance;
    touch.reduced_radius = reduced(sphere_a.radius, sphere_b.radius);
    touch.reduced_mass = reduced(bodies.mass[a], bodies.mass[b]);
    const Vector point = sphere_a.centre + touch.normal * (sphere_a.radius - touch.overlap / 2);
    const Vector arm_a = point - bodies.position[a];
    const Vector arm_b = point - bodies.position[b];
    touch.half_velocity = velocity_at(bodies, b, arm_b) - velocity_at(bodies, a, arm_a);
    touch.velocity = touch.half_velocity + kick_at(bodies, b, arm_b) - kick_at(bodies, a, arm_a);
    touch.twist = .5 * touch.normal.dot(bodies.spin[a] + bodies.spin[b]);
    const ContactForce force = contact_force(touch, *law, timestep_s, memory);

    load.force += force.total;
    load.torque_a += arm_a.cross(force.total);
    load.torque_b -= arm_b.cross(force.total);
    load.overlap =
        std::max(load.overlap, touch.overlap / std::min(sphere_a.radius, sphere_b.radius));
    if (law->rolling_friction == 0) continue;
    if (contacts.rolling() == RollingModel::constant_torque) {
      const double torque = law->rolling_friction * force.normal;
      load.rolling_a += torque * arm_a.norm();
      load.rolling_b += torque * arm_b.norm();
    } else if (contacts.rolling() != RollingModel::none) {
      const Roll roll{
          .normal = touch.normal,
          .spin = bodies.spin[a] - bodies.spin[b],
          .normal_force = force.normal,
          .overlap = touch.overlap,
          .reduced_radius = touch.reduced_radius,
          .reduced_inertia = reduced(inertia_about(bodies, a, 0), inertia_about(bodies, b, 0)),
          .contact_inertia = reduced(inertia_about(bodies, a, arm_a.norm()),
                                     inertia_about(bodies, b, arm_b.norm()))};
      const Vector torque = rolling_torque(contacts.rolling(), roll, *law, timestep_s, memory);
      load.torque_a += torque;
      load.torque_b -= torque;
    }
  }
  return load;
}

WallLoad ContactStep::load(const NearWall& pair, NeighbourList& list) const {
  WallLoad load;
  const auto a = static_cast<std::size_t>(pair.body);
  const WallMoment& moment = walls.moment(pair.wall);
  const ContactLaw& law = contacts.law(material(pair.body), walls.wall(pair.wall).material);
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const PlacedSphere& sphere = bodies.spheres[static_cast<std::size_t>(list.facets[at].sphere)];
    const FacetContact facet = walls.contact(pair.wall, list.facets[at].facet, sphere.centre);
    ContactMemory& memory = list.wall_memories[at];
    if (facet.distance >= sphere.radius) {
      if (memory.radius > 0) memory = {};
      continue;
    }
    Touch touch;
    touch.normal = -facet.normal;
    touch.overlap = sphere.radius - facet.distance;
    touch.reduced_radius = sphere.radius;
    touch.reduced_mass = bodies.mass[a];
    const Vector point = sphere.centre + touch.normal * (sphere.radius - touch.overlap / 2);
    const Vector arm = point - bodies.position[a];
    const Vector wall_velocity = moment.velocity_at(point);
    touch.half_velocity = wall_velocity - velocity_at(bodies, a, arm);
    touch.velocity = touch.half_velocity - kick_at(bodies, a, arm);
    touch.twist = .5 * touch.normal.dot(bodies.spin[a] + moment.spin);
    const ContactForce force = contact_force(touch, law, timestep_s, memory);

    load.force += force.total;
    load.torque += arm.cross(force.total);
    load.overlap = std::max(load.overlap, touch.overlap / sphere.radius);
    load.power_w += force.total.dot(wall_velocity);
    if (law.rolling_friction == 0) continue;
    if (contacts.rolling() == RollingModel::constant_torque) {
      load.rolling += law.rolling_friction * force.normal * arm.norm();
    } else if (contacts.rolling() != RollingModel::none) {
      const Roll roll{.normal = touch.normal,
                      .spin = bodies.spin[a] - moment.spin,
                      .normal_force = force.normal,
                      .overlap = touch.overlap,
                      .reduced_radius = touch.reduced_radius,
                      .reduced_inertia = inertia_about(bodies, a, 0),
                      .contact_inertia = inertia_about(bodies, a, arm.norm())};
      load.torque += rolling_torque(contacts.rolling(), roll, law, timestep_s, memory);
    }
  }
  return load;
}

ContactTally Interactions::apply(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                                 int threads) {
  ContactTally tally;
  if (threads > 1) {
    apply_pairs_in_parallel(bodies, step, list, threads);
    for (std::size_t k = 0; k < list.grains.size(); ++k) {
      note_overlap(pair_loads_[k].overlap, list.grains[k].a, tally);
    }
  } else {
    for (const NearGrains& pair : list.grains) {
      const PairLoad load = step.load(pair, list);
      if (load.overlap == 0) continue;
      add_to_a(bodies, pair, load);
      add_to_b(bodies, pair, load);
      note_overlap(load.overlap, pair.a, tally);
    }
  }
  wall_loads_.resize(list.walls.size());
  for_each_index(list.walls.size(), threads,
                 [&](std::size_t k) { wall_loads_[k] = step.load(list.walls[k], list); });
  for (std::size_t k = 0; k < list.walls.size(); ++k) {
    const WallLoad& load = wall_loads_[k];
    if (load.overlap == 0) continue;
    const auto body = static_cast<std::size_t>(list.walls[k].body);
    bodies.force[body] += load.force;
    bodies.torque[body] += load.torque;
    bodies.rolling_limit[body] += load.rolling;
    tally.wall_power_w += load.power_w;
    note_overlap(load.overlap, list.walls[k].body, tally);
  }
  return tally;
}

void Interactions::apply_pairs_in_parallel(Bodies& bodies, const ContactStep& step,
                                           NeighbourList& list, int threads) {
  pair_loads_.resize(list.grains.size());
  for_each_index(list.grains.size(), threads,
                 [&](std::size_t k) { pair_loads_[k] = step.load(list.grains[k], list); });
  for_each_index(bodies.size(), threads, [&](std::size_t body) {
    const auto begin = static_cast<std::size_t>(list.body_start[body]);
    const auto end = static_cast<std::size_t>(list.body_start[body + 1]);
    for (std::size_t at = begin; at < end; ++at) {
      const auto k = static_cast<std::size_t>(list.body_pairs[at]);
      if (pair_loads_[k].overlap == 0) continue;
      const NearGrains& pair = list.grains[k];
      if (pair.a == static_cast<int>(body)) {
        add_to_a(bodies, pair, pair_loads_[k]);
      } else {
        add_to_b(bodies, pair, pair_loads_[k]);
      }
    }
  });
}

}  // namespace repose::dem
