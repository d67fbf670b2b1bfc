#include "dem/engine/interactions.h"

#include <boost/container/static_vector.hpp>

#include "dem/engine/contact_force.h"
#include "dem/engine/parallel.h"
#include "dem/engine/rolling.h"

namespace repose::dem {
namespace {

double reduced(double x, double y) { return x * y / (x + y); }

/// Least moment about a point `arm` away from the centre of mass.
double inertia_about(const Bodies& bodies, std::size_t k, double arm) {
  return bodies.moments[k].minCoeff() + bodies.mass[k] * arm * arm;
}

/// How b's surface moves against a's at points near a's centre: u + w x (point - a's centre).
struct RelativeMotion {
  Vector velocity;
  Vector spin;
  Vector at(const Vector& arm) const { return velocity + spin.cross(arm); }
};

/// @param across  from b's centre to a's
RelativeMotion relative_motion(const Bodies& bodies, std::size_t a, std::size_t b,
                               const Vector& across) {
  return {bodies.velocity[b] - bodies.velocity[a] + bodies.spin[b].cross(across),
          bodies.spin[b] - bodies.spin[a]};
}

/// What half a step of the last forces adds to it.
RelativeMotion relative_kick(const Bodies& bodies, std::size_t a, std::size_t b,
                             const Vector& across) {
  return {bodies.velocity_kick[b] - bodies.velocity_kick[a] + bodies.spin_kick[b].cross(across),
          bodies.spin_kick[b] - bodies.spin_kick[a]};
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

/// But for the inertias.
Roll roll_of(const Touch& touch, const Vector& spin, const ContactForce& force) {
  return {.normal = touch.normal,
          .spin = spin,
          .normal_force = force.normal,
          .overlap = touch.overlap,
          .reduced_radius = touch.reduced_radius};
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

PairLoad ContactStep::load(NearGrains& pair, NeighbourList& list) const {
  PairLoad load;
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  const double reach = bodies.reach[a] + bodies.reach[b];
  const bool is_apart = (bodies.position[b] - bodies.position[a]).squaredNorm() >= reach * reach;
  if (is_apart && !pair.touched) return load;

  const auto first = static_cast<std::size_t>(pair.first);
  const auto end = first + static_cast<std::size_t>(pair.count);
  // Left as it is: no more than what is found is read.
  std::array<std::size_t, kBatch> touching;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  pair.touched = false;
  for (std::size_t from = first; from < end; from += kBatch) {
    const std::size_t count = find_touching(list, from, std::min(end, from + kBatch), touching);
    if (count == 0) continue;
    pair.touched = true;
    add_contacts(pair, {touching.data(), count}, list, load);
  }
  return load;
}

std::size_t ContactStep::find_touching(NeighbourList& list, std::size_t from, std::size_t to,
                                       std::array<std::size_t, kBatch>& touching) const {
  std::size_t count = 0;
  for (std::size_t k = from; k < to; ++k) {
    const PlacedSphere& a = bodies.spheres[static_cast<std::size_t>(list.spheres[k].a)];
    const PlacedSphere& b = bodies.spheres[static_cast<std::size_t>(list.spheres[k].b)];
    const double reach = a.radius + b.radius;
    const double distance2 = (b.centre - a.centre).squaredNorm();
    // Spheres of one centre have no normal to push along: the audit stops such a run.
    const bool touches = distance2 < reach * reach && distance2 > 0;
    if (!touches && list.memories[k].radius > 0) list.memories[k] = {};  // what has parted forgets
    touching[count] = k;
    count += touches ? 1 : 0;  // no branch: there is no pattern in who touches
  }
  return count;
}

void ContactStep::add_contacts(const NearGrains& pair, std::span<const std::size_t> touching,
                               NeighbourList& list, PairLoad& load) const {
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  const ContactLaw law = contacts.law(material(pair.a), material(pair.b));
  const Vector centre_a = bodies.position[a];
  const Vector across = centre_a - bodies.position[b];
  const RelativeMotion motion = relative_motion(bodies, a, b, across);
  const RelativeMotion kick = relative_kick(bodies, a, b, across);
  const Vector mean_spin = .5 * (bodies.spin[a] + bodies.spin[b]);
  Vector torque = Vector::Zero();
  Vector rolling = Vector::Zero();
  Vector sum = Vector::Zero();
  Touch touch;
  touch.reduced_mass = reduced(bodies.mass[a], bodies.mass[b]);
  touch.damper_limit = damper_limit(touch.reduced_mass, timestep_s, touching.size());
  for (const std::size_t k : touching) {
    const PlacedSphere& sphere_a = bodies.spheres[static_cast<std::size_t>(list.spheres[k].a)];
    const PlacedSphere& sphere_b = bodies.spheres[static_cast<std::size_t>(list.spheres[k].b)];
    const Vector apart = sphere_b.centre - sphere_a.centre;
    const double distance = apart.norm();
    touch.normal = apart * (1 / distance);
    touch.overlap = sphere_a.radius + sphere_b.radius - distance;
    touch.reduced_radius = reduced(sphere_a.radius, sphere_b.radius);
    const Vector arm =
        sphere_a.centre - centre_a + touch.normal * (sphere_a.radius - touch.overlap / 2);
    touch.half_velocity = motion.at(arm);
    touch.velocity = touch.half_velocity + kick.at(arm);
    touch.twist = touch.normal.dot(mean_spin);
    ContactMemory& memory = list.memories[k];
    const ContactForce force = contact_force(touch, law, timestep_s, memory);

    sum += force.total;
    torque += arm.cross(force.total);
    load.overlap =
        std::max(load.overlap, touch.overlap / std::min(sphere_a.radius, sphere_b.radius));
    if (law.rolling_friction == 0) continue;
    const double arm_b = (arm + across).norm();
    if (contacts.rolling() == RollingModel::constant_torque) {
      load.rolling_a += law.rolling_friction * force.normal * arm.norm();
      load.rolling_b += law.rolling_friction * force.normal * arm_b;
    } else if (contacts.rolling() != RollingModel::none) {
      Roll roll = roll_of(touch, -motion.spin, force);
      roll.reduced_inertia = reduced(inertia_about(bodies, a, 0), inertia_about(bodies, b, 0));
      roll.contact_inertia =
          reduced(inertia_about(bodies, a, arm.norm()), inertia_about(bodies, b, arm_b));
      rolling += rolling_torque(contacts.rolling(), roll, law, timestep_s, memory);
    }
  }
  load.force += sum;
  load.torque_a += torque + rolling;
  // b feels the opposite forces, at arms longer by `across`.
  load.torque_b -= torque + across.cross(sum) + rolling;
}

WallLoad ContactStep::load(const NearWall& pair, NeighbourList& list) const {
  WallLoad load;
  if (walls.has_facets(pair.wall)) hand_over_memories(pair, list);
  const auto first = static_cast<std::size_t>(pair.first);
  const auto end = first + static_cast<std::size_t>(pair.count);
  boost::container::static_vector<WallTouch, kWallBatch> touching;
  for (std::size_t from = first; from < end; from += kWallBatch) {
    touching.clear();
    for (std::size_t k = from; k < std::min(end, from + kWallBatch); ++k) {
      const auto at = static_cast<std::size_t>(list.facets[k].sphere);
      const FacetContact facet =
          walls.contact(pair.wall, list.facets[k].facet, bodies.spheres[at].centre);
      if (facet.distance < bodies.spheres[at].radius) {
        touching.push_back({.near = k, .facet = facet});
      } else if (list.wall_memories[k].radius > 0) {
        list.wall_memories[k] = {};  // what has parted forgets
      }
    }
    if (!touching.empty()) add_contacts(pair, {touching.data(), touching.size()}, list, load);
  }
  return load;
}

void ContactStep::hand_over_memories(const NearWall& pair, NeighbourList& list) const {
  const auto touches = [&](std::size_t k) {
    const auto sphere = static_cast<std::size_t>(list.facets[k].sphere);
    return walls.contact(pair.wall, list.facets[k].facet, bodies.spheres[sphere].centre).distance <
           bodies.spheres[sphere].radius;
  };
  auto first = static_cast<std::size_t>(pair.first);
  const std::size_t end = first + static_cast<std::size_t>(pair.count);
  while (first < end) {
    std::size_t last = first + 1;
    while (last < end && list.facets[last].sphere == list.facets[first].sphere) ++last;
    for (std::size_t from = first; from < last; ++from) {
      if (list.wall_memories[from].radius == 0 || touches(from)) continue;
      for (std::size_t to = first; to < last; ++to) {
        if (list.wall_memories[to].radius > 0 || !touches(to)) continue;
        std::swap(list.wall_memories[to], list.wall_memories[from]);
        break;
      }
    }
    first = last;
  }
}

void ContactStep::add_contacts(const NearWall& pair, std::span<const WallTouch> touching,
                               NeighbourList& list, WallLoad& load) const {
  const auto a = static_cast<std::size_t>(pair.body);
  const WallMoment& moment = walls.moment(pair.wall);
  const ContactLaw& law = contacts.law(material(pair.body), walls.wall(pair.wall).material);
  const Vector centre = bodies.position[a];
  Touch touch;
  touch.reduced_mass = bodies.mass[a];
  touch.damper_limit = damper_limit(touch.reduced_mass, timestep_s, touching.size());
  for (const auto& [near, facet] : touching) {
    const PlacedSphere& sphere = bodies.spheres[static_cast<std::size_t>(list.facets[near].sphere)];
    ContactMemory& memory = list.wall_memories[near];
    touch.normal = -facet.normal;
    touch.overlap = sphere.radius - facet.distance;
    touch.reduced_radius = sphere.radius;
    const Vector arm = sphere.centre - centre + touch.normal * (sphere.radius - touch.overlap / 2);
    const Vector wall_velocity = moment.velocity_at(centre + arm);
    touch.half_velocity = wall_velocity - bodies.velocity[a] - bodies.spin[a].cross(arm);
    touch.velocity = touch.half_velocity - bodies.velocity_kick[a] - bodies.spin_kick[a].cross(arm);
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
      Roll roll = roll_of(touch, bodies.spin[a] - moment.spin, force);
      roll.reduced_inertia = inertia_about(bodies, a, 0);
      roll.contact_inertia = inertia_about(bodies, a, arm.norm());
      load.torque += rolling_torque(contacts.rolling(), roll, law, timestep_s, memory);
    }
  }
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
    for (NearGrains& pair : list.grains) {
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
