#pragma once

#include <array>
#include <span>
#include <vector>

#include "dem/engine/bodies.h"
#include "dem/engine/neighbour_list.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// What the contacts of one pair of grains do to both.
struct PairLoad {
  Vector force = Vector::Zero();  ///< on a; b gets the opposite
  Vector torque_a = Vector::Zero();
  Vector torque_b = Vector::Zero();
  double rolling_a = 0;  ///< what constant-torque rolling friction may take
  double rolling_b = 0;
  double overlap = 0;  ///< deepest, as a share of the smaller sphere's radius; 0: no contact
};

/// What the contacts with one wall do to a grain.
struct WallLoad {
  Vector force = Vector::Zero();
  Vector torque = Vector::Zero();
  double rolling = 0;
  double overlap = 0;
  double power_w = 0;  ///< that the wall's motion puts into the grain
};

/// What the contacts of one step did besides pushing grains.
struct ContactTally {
  double wall_power_w = 0;
  double deepest_overlap = 0;
  int deepest_body = -1;
};

/// The contacts of one step: where the bodies are and what rules.
struct ContactStep {
  const Bodies& bodies;
  const WallSet& walls;
  const ContactTable& contacts;
  const std::vector<GrainKind>& kinds;
  double timestep_s;

  PairLoad load(NearGrains& pair, NeighbourList& list) const;
  WallLoad load(const NearWall& pair, NeighbourList& list) const;

 private:
  static constexpr std::size_t kBatch = 256;
  static constexpr std::size_t kWallBatch = 32;

  int material(int body) const;
  /// Numbers of the near spheres from ... to - 1 that touch; returns how many.
  std::size_t find_touching(NeighbourList& list, std::size_t from, std::size_t to,
                            std::array<std::size_t, kBatch>& touching) const;
  void add_contacts(const NearGrains& pair, std::span<const std::size_t> touching,
                    NeighbourList& list, PairLoad& load) const;
  /// A sphere that moves on to the next facet of a wall takes its contact's memory along.
  void hand_over_memories(const NearWall& pair, NeighbourList& list) const;
  struct WallTouch {
    std::size_t near = 0;  ///< number in NeighbourList::facets
    FacetContact facet;
  };
  void add_contacts(const NearWall& pair, std::span<const WallTouch> touching, NeighbourList& list,
                    WallLoad& load) const;
};

/// Works out the contacts of all bodies. Each body's sums are made in the order of the list, so
/// that the number of threads does not show in them.
class Interactions {
 public:
  /// Adds to `force`, `torque` and `rolling_limit` of the bodies.
  ContactTally apply(Bodies& bodies, const ContactStep& step, NeighbourList& list, int threads);

 private:
  void apply_pairs_in_parallel(Bodies& bodies, const ContactStep& step, NeighbourList& list,
                               int threads);

  std::vector<PairLoad> pair_loads_;
  std::vector<WallLoad> wall_loads_;
};

}  // namespace repose::dem
