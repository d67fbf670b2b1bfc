#pragma once

#include <string>

#include "vision/track/drop_track.h"

namespace repose::vision {

/// The strobe picture of a track with the fitted flights, their tops and the impacts drawn into it,
/// and below it each bounce's restitution, every warning, or the reason of a refusal.
/// @param title  the film's name
Picture draw_drop_overlay(const DropTrack& track, const std::string& title);

}  // namespace repose::vision
