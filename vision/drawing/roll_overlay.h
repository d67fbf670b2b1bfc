#pragma once

#include <string>

#include "vision/track/roll_track.h"

namespace repose::vision {

/// The strobe picture of a track with the grain's path, the two lines, the foot and the places of
/// release and rest drawn into it, and below it the readings, every warning, or the reason of a
/// refusal.
/// @param title  the film's name
Picture draw_roll_overlay(const RollTrack& track, const std::string& title);

}  // namespace repose::vision
