#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/engine/contact_step.h"
#include "dem/engine/four_contacts.h"
#include "dem/engine/neighbour_list.h"

namespace repose::dem {

/// Works out the contacts of a chunk (number: of kPairsTogether pairs of the list each, the last
/// fewer), as many as there are `loads`, and brings their memories up to date. The load of each
/// pair that touches is the sum over its contacts in the list's order; those of others are left
/// alone.
/// @return the deepest overlap, as a fraction of the smaller sphere's radius
double find_pair_loads(const ContactStep& step, NeighbourList& list, std::size_t number,
                       std::span<PairLoad> loads);

/// Where each wall is, and how it moves.
struct WallMotions {
  std::vector<Row> position;
  std::vector<BodyMotion> motion;
};

/// How each wall moves, as if it were a body without end of mass.
void find_wall_motions(const WallSet& walls, WallMotions& motions);

/// Works out the contacts of grains with walls, `first` ... of the list, as many as there are
/// `loads`, and brings their memories up to date.
/// @return the deepest overlap, as a fraction of the sphere's radius
double find_wall_loads(const ContactStep& step, const WallMotions& wall_motions,
                       NeighbourList& list, std::size_t first, std::span<PairLoad> loads);

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
