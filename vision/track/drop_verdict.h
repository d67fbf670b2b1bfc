#pragma once

#include <vector>

#include "vision/track/drop_candidate.h"
#include "vision/track/drop_track.h"
#include "vision/track/film_scale.h"

namespace repose::vision {

/// Gives a track its status, with the warnings or the reason of a refusal. A refused one has no
/// bounces.
/// @param candidates  the best first
void judge_drop(const FilmGrains& film, const std::vector<DropCandidate>& candidates,
                const FilmScale& scale, DropTrack& track);

}  // namespace repose::vision
