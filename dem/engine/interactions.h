#pragma once

#include <cstdint>
#include <vector>

#include "dem/engine/pair_contacts.h"
#include "dem/engine/wall_contacts.h"

namespace repose::dem {

/// What the contacts of one step did besides pushing grains.
struct ContactTally {
  double wall_power_w = 0;
  double deepest_overlap = 0;  ///< as a fraction of the smaller sphere's radius
};

/// Works out the contacts of all bodies. Each body's sums are made in the order of the list, so
/// that the number of threads does not show in them.
class Interactions {
 public:
  /// Adds to the loads of the bodies.
  ContactTally apply(Bodies& bodies, const ContactStep& step, NeighbourList& list, int threads);

 private:
  void apply_pairs(Bodies& bodies, const ContactStep& step, NeighbourList& list, int threads);
  void apply_walls(Bodies& bodies, const ContactStep& step, NeighbourList& list, int threads);

  void note_deepest();

  ContactTally tally_;
  std::vector<PairLoad> loads_;
  std::vector<std::uint8_t> touches_;  ///< whether each pair of grains does, 1 or 0
  std::vector<double> deepest_;        ///< of each chunk
  WallMotions wall_motions_;
};

}  // namespace repose::dem
