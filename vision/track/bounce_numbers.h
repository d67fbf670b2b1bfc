#pragma once

#include <optional>
#include <vector>

#include "vision/track/drop_candidate.h"
#include "vision/track/drop_track.h"

namespace repose::vision {

/// Which bounces of the grain those are that were read, counted from its release, or from the first
/// flight that is seen where the film begins with it.
struct BounceNumbers {
  std::vector<int> of_impacts;       ///< of each of the candidate's, from 1 on
  std::vector<UnreadBounce> unread;  ///< before the last of these
};

/// Bounces between two flights, of which no impact was read, are counted by the time between them:
/// from the speed v of the one landing to the speed w of the other's start, n impacts that restore
/// e = (w/v)^(1/n) each leave flights of 2 v e^i / g, i = 1 to n - 1 (free flight, Newton's law of
/// impact). Checked by BounceNumbers.* in tests/vision/bounce_numbers_test.cpp.
int impacts_between(double landing_px_s, double start_px_s, double gap_s, double gravity_px_s2);

BounceNumbers number_bounces(const DropCandidate& grain, const FilmGrains& film);

}  // namespace repose::vision
