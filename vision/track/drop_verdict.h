#pragma once

#include "vision/track/drop_timing.h"
#include "vision/track/drop_track.h"
#include "vision/track/film_scale.h"

namespace repose::vision {

/// Gives a track its status, with the warnings or the reason of a refusal. A refused one has no
/// bounces.
void judge_drop(const TimedDrop& drop, const FilmScale& scale, DropTrack& track);

}  // namespace repose::vision
