#pragma once

#include <string>

#include "vision/track/tilt_track.h"

namespace repose::vision {

/// The frame of the onset with the plate's edge at the beginning and at the onset, the grain's path
/// and the place of the onset drawn into it, and below it the angle, every warning, or the reason
/// of a refusal.
/// @param title  the film's name
Picture draw_tilt_overlay(const TiltTrack& track, const std::string& title);

}  // namespace repose::vision
