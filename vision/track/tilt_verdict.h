#pragma once

#include <string>
#include <vector>

#include "vision/track/plate_grain.h"
#include "vision/track/slide_onset.h"
#include "vision/track/tilt_track.h"

/// What keeps a film of a tilt from a reading, and what is to be known of one.
namespace repose::vision {

/// Why the plate's angle cannot be read; empty: it can.
std::string fault_of_plate(const std::optional<PlateMotion>& motion);

/// Why no slide can be read off what stands on the plate; empty: it can.
/// @param sliding  those that move, as numbers of tracks
std::string fault_of_grains(const PlateGrains& grains, const std::vector<std::size_t>& sliding,
                            const PlateMotion& motion);

/// Why what moves does not slide; empty: it does.
std::string fault_of_slide(const OnPlateTrack& grain, const PlateMotion& motion);

/// Adds what is to be known.
/// @param times_s  of all frames
/// @returns whether a person must look at something first
bool warn_of_tilt(const PlateMotion& motion, const OnPlateTrack& grain, const SlideOnset& onset,
                  const std::vector<double>& times_s, TiltTrack& track);

}  // namespace repose::vision
