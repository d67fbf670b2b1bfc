#include "dem/engine/neighbour_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/input_error.h"
#include "dem/engine/parallel.h"

namespace repose::dem {
namespace {

/// While a wall moves, everything is listed again after about this many steps.
constexpr double kWallSteps = 80;

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

/// Groups of near spheres or facets, and the contact history of each. Sorted by group and within
/// groups.
template <typename Group, typename Item>
struct Groups {
  std::vector<Group>& groups;
  std::vector<Item>& items;
  std::vector<ContactHistory>& memories;

  void clear() {
    groups.clear();
    items.clear();
    memories.clear();
  }
};

Groups<NeighbourPair, NearSpheres> pairs_in(NeighbourList& list) {
  return {list.grains, list.spheres, list.memories};
}
Groups<NearWall, NearFacet> walls_in(NeighbourList& list) {
  return {list.walls, list.facets, list.wall_memories};
}

/// Copies the histories of a group's items from the same group of an old list.
template <typename Group, typename Item>
void carry(const Groups<Group, Item>& old, const Group& old_group, const Groups<Group, Item>& now,
           const Group& group) {
  auto k = static_cast<std::size_t>(old_group.first);
  const std::size_t end = k + static_cast<std::size_t>(old_group.count);
  for (int item = group.first; item < group.first + group.count; ++item) {
    const auto to = static_cast<std::size_t>(item);
    while (k < end && comes_before(old.items[k], now.items[to])) ++k;
    if (k == end) return;
    if (!comes_before(now.items[to], old.items[k])) now.memories[to] = old.memories[k];
  }
}

/// The same for all groups.
template <typename Group, typename Item>
void carry_all(const Groups<Group, Item>& old, const Groups<Group, Item>& now) {
  auto old_group = old.groups.begin();
  for (const Group& group : now.groups) {
    while (old_group != old.groups.end() && comes_before(*old_group, group)) ++old_group;
    if (old_group == old.groups.end()) return;
    if (!comes_before(group, *old_group)) carry(old, *old_group, now, group);
  }
}

/// Builds a list from an old one, in order: most groups are kept, those of moved bodies are
/// replaced.
template <typename Group, typename Item, typename HasMoved>
class Renewal {
 public:
  /// @param has_moved  whether a group of the old list is left out
  Renewal(const Groups<Group, Item>& old, const Groups<Group, Item>& now, const HasMoved& has_moved)
      : old_(old), now_(now), has_moved_(has_moved), at_(old.groups.begin()) {
    now_.clear();
  }

  /// Makes a group of the items that `add_items` appends, if any, with their previous histories.
  template <typename AddItems>
  void add(Group group, const AddItems& add_items) {
    keep_until(&group);
    group.first = static_cast<int>(now_.items.size());
    add_items();
    group.count = static_cast<int>(now_.items.size()) - group.first;
    if (group.count == 0) return;
    now_.memories.resize(now_.items.size());
    now_.groups.push_back(group);
    if (at_ != old_.groups.end() && !comes_before(group, *at_)) carry(old_, *at_, now_, group);
  }

  void finish() { keep_until(nullptr); }

 private:
  using At = typename std::vector<Group>::const_iterator;

  /// Keeps the old groups that come before `next`, or all that are left.
  void keep_until(const Group* next) {
    const auto is_before = [&](const At& at) {
      return at != old_.groups.end() && (next == nullptr || comes_before(*at, *next));
    };
    while (is_before(at_)) {
      const At first = at_;
      while (is_before(at_) && !has_moved_(*at_)) ++at_;
      if (first != at_) keep(first, at_);
      while (is_before(at_) && has_moved_(*at_)) ++at_;
    }
  }

  void keep(const At& first, const At& end) {
    const std::ptrdiff_t from = first->first;
    const std::ptrdiff_t to = (end - 1)->first + (end - 1)->count;
    const int shift = static_cast<int>(now_.items.size()) - first->first;
    now_.items.insert(now_.items.end(), old_.items.begin() + from, old_.items.begin() + to);
    now_.memories.insert(now_.memories.end(), old_.memories.begin() + from,
                         old_.memories.begin() + to);
    for (At at = first; at != end; ++at) {
      now_.groups.push_back(*at);
      now_.groups.back().first += shift;
    }
  }

  Groups<Group, Item> old_, now_;
  const HasMoved& has_moved_;
  At at_;
};

}  // namespace

void Neighbours::update(const Bodies& bodies, const WallSet& walls, double time_s,
                        double timestep_s, int threads) {
  const bool is_all_due = is_expired_ || time_s >= due_s_;
  if (!is_all_due && !margins_.is_used_up(bodies, threads)) return;
  if (is_all_due) {
    has_moved_.assign(bodies.size(), 1);
  } else {
    margins_.note_half_used(bodies, has_moved_, threads);
  }
  renew_margins(bodies, timestep_s, threads);
  if (is_all_due) set_wall_margin(bodies, walls, time_s, timestep_s);
  find_pairs(bodies, threads);
  find_spheres(bodies, threads);
  list_grains();
  list_walls(bodies, walls);
  std::swap(list_, next_);
  note_touching();
  if (threads > 1) index_by_body(bodies.size());
  is_expired_ = false;
}

void Neighbours::renew_margins(const Bodies& bodies, double timestep_s, int threads) {
  margins_.resize(bodies);
  columns_.resize(bodies.spheres.size());
  for_each_index(bodies.size(), threads, [&](std::size_t k) {
    if (has_moved_[k] == 0) return;
    margins_.renew(bodies, k, timestep_s);
    columns_.take_in(bodies, k);
  });
}

void Neighbours::set_wall_margin(const Bodies& bodies, const WallSet& walls, double time_s,
                                 double timestep_s) {
  Eigen::AlignedBox3d occupied;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    const Vector reach = Vector::Constant(bodies.bounding_radius[k]);
    occupied.extend(bodies.position[k].xyz - reach);
    occupied.extend(bodies.position[k].xyz + reach);
  }
  const double speed = walls.greatest_speed(time_s, occupied);
  wall_margin_ = speed * timestep_s * kWallSteps;
  // Half a step early, as times are rounded.
  due_s_ = speed > 0 ? time_s + (kWallSteps - .5) * timestep_s : HUGE_VAL;
}

/// All pairs with a moved body, in order.
void Neighbours::find_pairs(const Bodies& bodies, int threads) {
  grid_.sort(bodies, margins_);
  found_.resize(std::max(found_.size(), chunks_of(bodies.size(), kLookedAtTogether)));
  for (Found& found : found_) found.pairs.clear();
  for_each_chunk(bodies.size(), kLookedAtTogether, threads, [&](const Chunk& chunk) {
    for (std::size_t k = chunk.first; k < chunk.end; ++k) {
      add_pairs(bodies, k, found_[chunk.number]);
    }
  });
  pairs_.clear();
  for (const Found& found : found_) {
    pairs_.insert(pairs_.end(), found.pairs.begin(), found.pairs.end());
  }
  sort_all(pairs_, threads,
           [](const NeighbourPair& x, const NeighbourPair& y) { return comes_before(x, y); });
}

/// Pairs of a body that has moved; if both have moved, the first one lists the pair.
void Neighbours::add_pairs(const Bodies& bodies, std::size_t body, Found& found) const {
  if (has_moved_[body] == 0 || !bodies.is_present(body)) return;
  const auto number = static_cast<int>(body);
  found.near.clear();
  grid_.add_near(number, found.near);
  for (const int other : found.near) {
    if (other > number) {
      found.pairs.push_back({.a = number, .b = other});
    } else if (has_moved_[static_cast<std::size_t>(other)] == 0) {
      found.pairs.push_back({.a = other, .b = number});
    }
  }
}

/// The near spheres of these pairs.
void Neighbours::find_spheres(const Bodies& bodies, int threads) {
  found_.resize(std::max(found_.size(), chunks_of(pairs_.size(), kLookedAtTogether)));
  for_each_chunk(pairs_.size(), kLookedAtTogether, threads, [&](const Chunk& chunk) {
    std::vector<NearSpheres>& spheres = found_[chunk.number].spheres;
    spheres.clear();
    for (std::size_t k = chunk.first; k < chunk.end; ++k) {
      NeighbourPair& pair = pairs_[k];
      pair.first = static_cast<int>(spheres.size());
      columns_.add_near(bodies, margins_, pair.a, pair.b, spheres);
      pair.count = static_cast<int>(spheres.size()) - pair.first;
    }
  });
}

void Neighbours::list_grains() {
  const auto has_moved = [&](const NeighbourPair& pair) {
    return (has_moved_[static_cast<std::size_t>(pair.a)] |
            has_moved_[static_cast<std::size_t>(pair.b)]) != 0;
  };
  Renewal renewal(pairs_in(list_), pairs_in(next_), has_moved);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const NeighbourPair& pair = pairs_[k];
    const auto first = found_[k / kLookedAtTogether].spheres.begin() + pair.first;
    renewal.add(pair,
                [&] { next_.spheres.insert(next_.spheres.end(), first, first + pair.count); });
  }
  renewal.finish();
}

void Neighbours::list_walls(const Bodies& bodies, const WallSet& walls) {
  const auto has_moved = [&](const NearWall& pair) {
    return has_moved_[static_cast<std::size_t>(pair.body)] != 0;
  };
  Renewal renewal(walls_in(list_), walls_in(next_), has_moved);
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    const auto k = static_cast<std::size_t>(body);
    if (has_moved_[k] == 0 || !bodies.is_present(k)) continue;
    const double margin = margins_.margin_m(body) + wall_margin_;
    for (int wall = 0; wall < walls.size(); ++wall) {
      if (!walls.is_present(wall)) continue;
      walls.facets_near(wall, bodies.position[k].xyz, bodies.bounding_radius[k] + margin, near_);
      if (near_.empty()) continue;
      renewal.add({.body = body, .wall = wall}, [&] {
        for (int s = bodies.first_sphere[k]; s < bodies.first_sphere[k + 1]; ++s) {
          const PlacedSphere& sphere = bodies.spheres[static_cast<std::size_t>(s)];
          walls.facets_near(wall, sphere.centre, sphere.radius + margin, near_);
          for (const int facet : near_) next_.facets.push_back({.sphere = s, .facet = facet});
        }
      });
    }
  }
  renewal.finish();
}

void Neighbours::look_up_again() {
  for (TouchingChunk& chunk : list_.touching) chunk.is_known = false;
}

void Neighbours::note_touching() {
  list_.touching.resize(chunks_of(list_.grains.size(), kPairsTogether));
  look_up_again();
  list_.has_touched.resize(list_.memories.size());
  for (std::size_t k = 0; k < list_.memories.size(); ++k) {
    list_.has_touched[k] = list_.memories[k].radius > 0 ? 1 : 0;
  }
}

void Neighbours::index_by_body(std::size_t bodies) {
  auto& start = list_.body_start;
  start.assign(bodies + 2, 0);
  for (const NeighbourPair& pair : list_.grains) {
    ++start[static_cast<std::size_t>(pair.a) + 2];
    ++start[static_cast<std::size_t>(pair.b) + 2];
  }
  for (std::size_t k = 2; k < start.size(); ++k) start[k] += start[k - 1];
  list_.body_pairs.resize(2 * list_.grains.size());
  // start[body + 1] advances from the start of the body's part to its end.
  for (std::size_t k = 0; k < list_.grains.size(); ++k) {
    for (const int body : {list_.grains[k].a, list_.grains[k].b}) {
      const int at = start[static_cast<std::size_t>(body) + 1]++;
      list_.body_pairs[static_cast<std::size_t>(at)] = static_cast<int>(k);
    }
  }
}

void Neighbours::forget_grain(int grain) {
  is_expired_ = true;
  for (const NeighbourPair& pair : list_.grains) {
    if (pair.a != grain && pair.b != grain) continue;
    std::fill_n(list_.memories.begin() + pair.first, pair.count, ContactHistory{});
  }
  for (const NearWall& pair : list_.walls) {
    if (pair.body != grain) continue;
    std::fill_n(list_.wall_memories.begin() + pair.first, pair.count, ContactHistory{});
  }
}

void Neighbours::forget_wall(int wall) {
  is_expired_ = true;
  for (const NearWall& pair : list_.walls) {
    if (pair.wall != wall) continue;
    std::fill_n(list_.wall_memories.begin() + pair.first, pair.count, ContactHistory{});
  }
}

std::vector<ContactState> Neighbours::touching(const Bodies& bodies) const {
  std::vector<ContactState> contacts;
  const auto within = [&bodies](int sphere) {
    const auto k = static_cast<std::size_t>(sphere);
    return sphere - bodies.first_sphere[static_cast<std::size_t>(bodies.sphere_body[k])];
  };
  const auto add = [&](int a, int sphere_a, int b, int sphere_b, const ContactHistory& memory) {
    if (memory.radius == 0) return;
    contacts.push_back({.grain_a = a,
                        .sphere_a = within(sphere_a),
                        .grain_b = b,
                        .sphere_b = sphere_b,
                        .contact_radius_m = memory.radius,
                        .tangential_n = memory.tangential,
                        .rolling_n_m = memory.rolling,
                        .normal_force_n = memory.push});
  };
  for (const NeighbourPair& pair : list_.grains) {
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
    const ContactHistory memory{.tangential = contact.tangential_n,
                                .radius = contact.contact_radius_m,
                                .rolling = contact.rolling_n_m,
                                .push = contact.normal_force_n};
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
  carry_all(pairs_in(remembered), pairs_in(list_));
  carry_all(walls_in(remembered), walls_in(list_));
  note_touching();
  const auto touching = [](const std::vector<ContactHistory>& memories) {
    return std::count_if(memories.begin(), memories.end(),
                         [](const ContactHistory& memory) { return memory.radius > 0; });
  };
  if (touching(list_.memories) + touching(list_.wall_memories) !=
      static_cast<std::ptrdiff_t>(contacts.size())) {
    throw base::InputError(
        {.where = "checkpoint",
         .value =
             "some of its contacts are of spheres that are not near each other, or not in order",
         .fix = "go on from a checkpoint that was not changed."});
  }
}

}  // namespace repose::dem
