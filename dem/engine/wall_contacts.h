#pragma once

#include <span>
#include <vector>

#include "dem/engine/contact_step.h"
#include "dem/engine/four_contacts.h"
#include "dem/engine/neighbour_list.h"

namespace repose::dem {

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

}  // namespace repose::dem
