#include "dem/engine/neighbour_list.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "dem/engine/four_contacts.h"

namespace repose::dem {
namespace {

/// Margin of a grain at rest, as a fraction of its reach.
constexpr double kRestMargin = .001;
/// A moving grain's margin lasts for about so many steps ...
constexpr double kHorizonSteps = 50;
/// ... but is at most this fraction of its reach.
constexpr double kGreatestMargin = .6;
/// The list is made anew after so many steps while a wall moves.
constexpr std::int64_t kWallSteps = 80;

template <typename Pair>
bool comes_before(const Pair& x, const Pair& y) {
  return std::tie(x.a, x.b) < std::tie(y.a, y.b);
}
bool comes_before(const NearFacet& x, const NearFacet& y) {
  return std::tie(x.sphere, x.facet) < std::tie(y.sphere, y.facet);
}
bool comes_before(const NearWall& x, const NearWall& y) {
  return std::tie(x.body, x.wall) < std::tie(y.body, y.wall);
}

/// Both lists are sorted, in groups and within them: one walk over both finds the common entries.
template <typename Group, typename Item>
void carry(const std::vector<Group>& old_groups, const std::vector<Item>& old_items,
           const std::vector<ContactMemory>& old_memories, const std::vector<Group>& groups,
           const std::vector<Item>& items, std::vector<ContactMemory>& memories) {
  memories.assign(items.size(), ContactMemory{});
  auto old_group = old_groups.begin();
  for (const Group& group : groups) {
    while (old_group != old_groups.end() && comes_before(*old_group, group)) ++old_group;
    if (old_group == old_groups.end()) return;
    if (comes_before(group, *old_group)) continue;
    auto k = static_cast<std::size_t>(old_group->first);
    const std::size_t end = k + static_cast<std::size_t>(old_group->count);
    for (int item = group.first; item < group.first + group.count; ++item) {
      const auto to = static_cast<std::size_t>(item);
      while (k < end && comes_before(old_items[k], items[to])) ++k;
      if (k == end) break;
      if (!comes_before(items[to], old_items[k])) memories[to] = old_memories[k];
    }
  }
}

/// Distance from one of four rows to the other, squared.
REPOSE_INLINE Lanes distance2(const Row* from, const Row* to) {
  return gather([&](std::size_t k) { return load_row(to[k]) - load_row(from[k]); })
      .xyz.squared_norm();
}

/// Whether some body's spheres can have come farther than its margin, by moving and by turning.
REPOSE_FOR_EACH_MACHINE
bool has_left_margin(const Bodies& bodies, const std::vector<Row>& position,
                     const std::array<std::vector<double>, 4>& orientation,
                     const std::vector<double>& margin) {
  for (std::size_t k = 0; k < bodies.size(); k += kLanes) {
    Lanes left = load(&margin[k]);
    if (!bodies.is_round) {
      Lanes turned;
      for (std::size_t i = 0; i < 4; ++i) {
        turned += load(&bodies.orientation[i][k]) * load(&orientation[i][k]);
      }
      const Lanes way = sqrt(greatest(Lanes(0), 1 - turned * turned));
      left = left - 2 * load(&bodies.bounding_radius[k]) * way;
    }
    const LaneMask has_left =
        (left <= Lanes(0)) | (distance2(&position[k], &bodies.position[k]) > left * left);
    if (any(has_left & (load(&bodies.presence[k]) > Lanes(0)))) return true;
  }
  return false;
}

}  // namespace

void Neighbours::update(const Bodies& bodies, const WallSet& walls, double time_s,
                        double timestep_s, std::int64_t step) {
  if (!is_due(bodies, step)) return;
  set_margins(bodies, walls, time_s, timestep_s, step);
  sort_into_cells(bodies);
  next_.grains.clear();
  next_.spheres.clear();
  list_grains(bodies);
  next_.walls.clear();
  next_.facets.clear();
  list_walls(bodies, walls);
  carry_memories();
  index_by_body(bodies.size());
  is_expired_ = false;
}

bool Neighbours::is_due(const Bodies& bodies, std::int64_t step) const {
  return is_expired_ || step >= due_step_ ||
         has_left_margin(bodies, position_, orientation_, margin_);
}

void Neighbours::set_margins(const Bodies& bodies, const WallSet& walls, double time_s,
                             double timestep_s, std::int64_t step) {
  position_ = bodies.position;
  orientation_ = bodies.orientation;
  margin_.resize(bodies.presence.size());  // longer, as the bodies' own arrays
  Eigen::AlignedBox3d occupied;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double turning =
        bodies.is_round ? 0 : bodies.bounding_radius[k] * bodies.motion[k].spin.xyz.norm();
    const double speed = bodies.velocity[k].norm() + turning;
    margin_[k] = bodies.bounding_radius[k] *
                 std::min(kGreatestMargin, kRestMargin + kHorizonSteps * timestep_s * speed /
                                                             bodies.bounding_radius[k]);
    if (bodies.is_present(k)) {
      const Vector reach = Vector::Constant(bodies.bounding_radius[k]);
      occupied.extend(bodies.position[k].xyz - reach);
      occupied.extend(bodies.position[k].xyz + reach);
    }
  }
  const double wall_speed = walls.greatest_speed(time_s, occupied);
  wall_margin_ = wall_speed * timestep_s * static_cast<double>(kWallSteps);
  due_step_ = wall_speed > 0 ? step + kWallSteps : INT64_MAX;
}

void Neighbours::sort_into_cells(const Bodies& bodies) {
  Vector low = Vector::Constant(1e300);
  Vector high = Vector::Constant(-1e300);
  double widest = 0;
  std::size_t present = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    ++present;
    low = low.cwiseMin(bodies.position[k].xyz);
    high = high.cwiseMax(bodies.position[k].xyz);
    widest = std::max(widest, bodies.bounding_radius[k] + margin_[k]);
  }
  if (present == 0) low = high = Vector::Zero();
  corner_ = low;
  cell_size_ = std::max(2 * widest, 1e-12);
  // Stray grains far away must not make for more cells than grains.
  const Vector extent = high - low;
  const double max_cells = 8.0 * static_cast<double>(present) + 64;
  const auto cells_at = [&extent](double size) {
    return ((extent.array() / size).floor() + 1).matrix().eval();
  };
  while (cells_at(cell_size_).prod() > max_cells) cell_size_ *= 1.3;
  cells_ = cells_at(cell_size_).cast<int>();

  cell_of_.assign(bodies.size(), -1);
  cell_start_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    const Eigen::Vector3i at =
        ((bodies.position[k].xyz - corner_) / cell_size_).array().floor().cast<int>().matrix();
    cell_of_[k] = (at.z() * cells_.y() + at.y()) * cells_.x() + at.x();
    ++cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  cell_bodies_.resize(present);
  for (std::size_t k = bodies.size(); k-- > 0;) {
    if (cell_of_[k] < 0) continue;
    auto& end = cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
    cell_bodies_[static_cast<std::size_t>(--end)] = static_cast<int>(k);
  }
  // Filled from the back, every entry now holds the start of its own cell, shifted by one.
  cell_start_.erase(cell_start_.begin());
  cell_start_.push_back(static_cast<int>(present));
}

void Neighbours::find_near(const Bodies& bodies, int body) {
  near_.clear();
  const auto k = static_cast<std::size_t>(body);
  const int cell = cell_of_[k];
  const int x = cell % cells_.x();
  const int y = cell / cells_.x() % cells_.y();
  const int z = cell / (cells_.x() * cells_.y());
  const int from_x = std::max(x - 1, 0);
  const int to_x = std::min(x + 1, cells_.x() - 1);
  for (int cz = std::max(z - 1, 0); cz <= std::min(z + 1, cells_.z() - 1); ++cz) {
    for (int cy = std::max(y - 1, 0); cy <= std::min(y + 1, cells_.y() - 1); ++cy) {
      const int row = (cz * cells_.y() + cy) * cells_.x();
      const auto first = static_cast<std::size_t>(row) + static_cast<std::size_t>(from_x);
      const auto last = static_cast<std::size_t>(row) + static_cast<std::size_t>(to_x);
      const int begin = cell_start_[first];
      const int end = cell_start_[last + 1];
      for (int at = begin; at < end; ++at) {
        const int other = cell_bodies_[static_cast<std::size_t>(at)];
        if (other <= body) continue;
        const auto o = static_cast<std::size_t>(other);
        const double reach =
            bodies.bounding_radius[k] + margin_[k] + bodies.bounding_radius[o] + margin_[o];
        if ((bodies.position[o].xyz - bodies.position[k].xyz).squaredNorm() < reach * reach) {
          near_.push_back(other);
        }
      }
    }
  }
  std::sort(near_.begin(), near_.end());
}

void Neighbours::list_grains(const Bodies& bodies) {
  columns_.gather(bodies);
  for (int a = 0; a < static_cast<int>(bodies.size()); ++a) {
    const auto ka = static_cast<std::size_t>(a);
    if (!bodies.is_present(ka)) continue;
    find_near(bodies, a);
    for (const int b : near_) {
      const auto kb = static_cast<std::size_t>(b);
      const double margin = margin_[ka] + margin_[kb];
      const auto first = static_cast<int>(next_.spheres.size());
      columns_.add_near(bodies, a, b, margin, next_.spheres);
      const auto count = static_cast<int>(next_.spheres.size()) - first;
      if (count > 0) next_.grains.push_back({.a = a, .b = b, .first = first, .count = count});
    }
  }
}

void Neighbours::list_walls(const Bodies& bodies, const WallSet& walls) {
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    const auto k = static_cast<std::size_t>(body);
    if (!bodies.is_present(k)) continue;
    const double margin = margin_[k] + wall_margin_;
    for (int wall = 0; wall < walls.size(); ++wall) {
      if (!walls.is_present(wall)) continue;
      walls.facets_near(wall, bodies.position[k].xyz, bodies.bounding_radius[k] + margin, near_);
      if (near_.empty()) continue;
      const auto first = static_cast<int>(next_.facets.size());
      for (int s = bodies.first_sphere[k]; s < bodies.first_sphere[k + 1]; ++s) {
        const PlacedSphere& sphere = bodies.spheres[static_cast<std::size_t>(s)];
        walls.facets_near(wall, sphere.centre, sphere.radius + margin, near_);
        for (const int facet : near_) next_.facets.push_back({.sphere = s, .facet = facet});
      }
      const auto count = static_cast<int>(next_.facets.size()) - first;
      if (count > 0) {
        next_.walls.push_back({.body = body, .wall = wall, .first = first, .count = count});
      }
    }
  }
}

void Neighbours::carry_memories() {
  carry(list_.grains, list_.spheres, list_.memories, next_.grains, next_.spheres, next_.memories);
  carry(list_.walls, list_.facets, list_.wall_memories, next_.walls, next_.facets,
        next_.wall_memories);
  std::swap(list_, next_);
  note_touching();
}

void Neighbours::note_touching() {
  list_.touching.resize((list_.grains.size() + kPairsTogether - 1) / kPairsTogether);
  for (TouchingChunk& chunk : list_.touching) chunk.is_known = false;
  list_.has_touched.resize(list_.memories.size());
  for (std::size_t k = 0; k < list_.memories.size(); ++k) {
    list_.has_touched[k] = list_.memories[k].radius > 0 ? 1 : 0;
  }
}

void Neighbours::index_by_body(std::size_t bodies) {
  auto& start = list_.body_start;
  start.assign(bodies + 2, 0);
  for (const NearGrains& pair : list_.grains) {
    ++start[static_cast<std::size_t>(pair.a) + 2];
    ++start[static_cast<std::size_t>(pair.b) + 2];
  }
  for (std::size_t k = 2; k < start.size(); ++k) start[k] += start[k - 1];
  list_.body_pairs.resize(2 * list_.grains.size());
  // start[body + 1] runs from where the body's part starts to where it ends.
  for (std::size_t k = 0; k < list_.grains.size(); ++k) {
    for (const int body : {list_.grains[k].a, list_.grains[k].b}) {
      const int at = start[static_cast<std::size_t>(body) + 1]++;
      list_.body_pairs[static_cast<std::size_t>(at)] = static_cast<int>(k);
    }
  }
}

void Neighbours::forget_grain(int grain) {
  is_expired_ = true;
  for (const NearGrains& pair : list_.grains) {
    if (pair.a != grain && pair.b != grain) continue;
    std::fill_n(list_.memories.begin() + pair.first, pair.count, ContactMemory{});
  }
  for (const NearWall& pair : list_.walls) {
    if (pair.body != grain) continue;
    std::fill_n(list_.wall_memories.begin() + pair.first, pair.count, ContactMemory{});
  }
}

void Neighbours::forget_wall(int wall) {
  is_expired_ = true;
  for (const NearWall& pair : list_.walls) {
    if (pair.wall != wall) continue;
    std::fill_n(list_.wall_memories.begin() + pair.first, pair.count, ContactMemory{});
  }
}

std::vector<ContactState> Neighbours::touching(const Bodies& bodies) const {
  std::vector<ContactState> contacts;
  const auto within = [&bodies](int sphere) {
    const auto k = static_cast<std::size_t>(sphere);
    return sphere - bodies.first_sphere[static_cast<std::size_t>(bodies.sphere_body[k])];
  };
  const auto add = [&](int a, int sphere_a, int b, int sphere_b, const ContactMemory& memory) {
    if (memory.radius == 0) return;
    contacts.push_back({.grain_a = a,
                        .sphere_a = within(sphere_a),
                        .grain_b = b,
                        .sphere_b = sphere_b,
                        .contact_radius_m = memory.radius,
                        .tangential_n = memory.tangential,
                        .rolling_n_m = memory.rolling,
                        .push_n = memory.push});
  };
  for (const NearGrains& pair : list_.grains) {
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const NearSpheres& spheres = list_.spheres[at];
      add(pair.a, spheres.a, pair.b, within(spheres.b), list_.memories[at]);
    }
  }
  for (const NearWall& pair : list_.walls) {
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const NearFacet& near = list_.facets[at];
      add(pair.body, near.sphere, -1 - pair.wall, near.facet, list_.wall_memories[at]);
    }
  }
  return contacts;
}

void Neighbours::restore(const Bodies& bodies, const std::vector<ContactState>& contacts) {
  NeighbourList remembered;
  for (const ContactState& contact : contacts) {
    const auto a = static_cast<std::size_t>(contact.grain_a);
    const int sphere_a = bodies.first_sphere.at(a) + contact.sphere_a;
    const ContactMemory memory{.tangential = contact.tangential_n,
                               .radius = contact.contact_radius_m,
                               .rolling = contact.rolling_n_m,
                               .push = contact.push_n};
    if (contact.grain_b >= 0) {
      const auto b = static_cast<std::size_t>(contact.grain_b);
      const auto first = static_cast<int>(remembered.spheres.size());
      remembered.spheres.push_back(
          {.a = sphere_a, .b = bodies.first_sphere.at(b) + contact.sphere_b});
      remembered.memories.push_back(memory);
      auto& groups = remembered.grains;
      if (groups.empty() || groups.back().a != contact.grain_a ||
          groups.back().b != contact.grain_b) {
        groups.push_back({.a = contact.grain_a, .b = contact.grain_b, .first = first});
      }
      ++groups.back().count;
    } else {
      const auto first = static_cast<int>(remembered.facets.size());
      const int wall = -1 - contact.grain_b;
      remembered.facets.push_back({.sphere = sphere_a, .facet = contact.sphere_b});
      remembered.wall_memories.push_back(memory);
      auto& groups = remembered.walls;
      if (groups.empty() || groups.back().body != contact.grain_a || groups.back().wall != wall) {
        groups.push_back({.body = contact.grain_a, .wall = wall, .first = first});
      }
      ++groups.back().count;
    }
  }
  carry(remembered.grains, remembered.spheres, remembered.memories, list_.grains, list_.spheres,
        list_.memories);
  carry(remembered.walls, remembered.facets, remembered.wall_memories, list_.walls, list_.facets,
        list_.wall_memories);
  note_touching();
  const auto touching = [](const std::vector<ContactMemory>& memories) {
    return std::count_if(memories.begin(), memories.end(),
                         [](const ContactMemory& memory) { return memory.radius > 0; });
  };
  if (touching(list_.memories) + touching(list_.wall_memories) !=
      static_cast<std::ptrdiff_t>(contacts.size())) {
    throw std::invalid_argument(
        "checkpoint: some of its contacts are of spheres that are not near each other, or not in "
        "order. Fix: go on from a checkpoint that was not changed.");
  }
}

}  // namespace repose::dem
