#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/contact_step.h"
#include "dem/engine/four_contacts.h"
#include "dem/engine/neighbour_list.h"

namespace repose::dem {

/// Computes the contacts of chunk `number` (chunks of kPairsTogether pairs of the list, the last
/// one may be shorter; `loads` has one entry per pair) and updates their histories. The load of
/// each touching pair is the sum over its contacts in list order; other entries are unchanged.
/// @return the deepest overlap, as a fraction of the smaller sphere's radius
double find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t number,
                       std::span<PairLoad> loads);

/// Position and motion of each wall.
struct WallMotions {
  std::vector<Row> position;
  std::vector<BodyMotion> motion;
};

/// The motion of each wall, as of a body of infinite mass.
void find_wall_motions(const WallSet& walls, WallMotions& motions);

/// Computes the contacts of grains with walls, entries `first` ... of the list, one per entry of
/// `loads`, and updates their histories.
/// @return the deepest overlap, as a fraction of the sphere's radius
double find_wall_loads(const ContactStep& step, const WallMotions& wall_motions,
                       NeighbourList& list, std::size_t first, std::span<PairLoad> loads);

/// What the contacts of one step gave besides loads on grains.
struct ContactTally {
  double wall_power_w = 0;
  double deepest_overlap = 0;  ///< as a fraction of the smaller sphere's radius
};

/// Computes the contacts of all bodies. Each body's sums are made in list order, so that they do
/// not depend on the number of threads.
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
  std::vector<std::uint8_t> touches_;  ///< whether each pair of grains touches, 1 or 0
  std::vector<double> deepest_;        ///< of each chunk
  WallMotions wall_motions_;
};

}  // namespace repose::dem
