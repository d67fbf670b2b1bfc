#pragma once

#include <span>

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

}  // namespace repose::dem
