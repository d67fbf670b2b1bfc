#pragma once

#include <string>

#include "vision/track/drop_track.h"
#include "vision/track/roll_track.h"
#include "vision/track/tilt_track.h"

namespace repose::vision {

/// The strobe picture of a track with the fitted flights, their tops and the impacts drawn into it;
/// below, each bounce's restitution, every warning, or the reason for a refusal.
/// @param title  the film's name
Picture draw_drop_overlay(const DropTrack& track, const std::string& title);

/// The strobe picture of a track with the grain's path, the two lines, the foot and the places of
/// release and rest drawn into it; below, the readings, every warning, or the reason for a refusal.
/// @param title  the film's name
Picture draw_roll_overlay(const RollTrack& track, const std::string& title);

/// The frame of the onset with the plate's edge at the beginning and at the onset, the grain's path
/// and the place of the onset drawn into it; below, the angle, every warning, or the reason for a
/// refusal.
/// @param title  the film's name
Picture draw_tilt_overlay(const TiltTrack& track, const std::string& title);

}  // namespace repose::vision
