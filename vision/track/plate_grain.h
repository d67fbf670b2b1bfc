#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/track/plate_motion.h"

namespace repose::vision {

/// Something that stands on the plate, in the plate's strip before it moves.
struct OnPlate {
  cv::Mat mask;             ///< of the strip's size
  cv::Point2d centre = {};  ///< in the strip
  double width_px = 0;      ///< along the plate
  double height_px = 0;
  double elongation = 1;      ///< length over breadth; 1: round
  bool touches_edge = false;  ///< part of it may be out of view
};

/// Its position in one frame.
struct OnPlateSighting {
  std::size_t plate = 0;  ///< index in PlateMotion::seen
  double time_s = 0;
  double slid_px = 0;     ///< down the plate, from its initial place
  double rise_px = 0;     ///< off the plate
  double turned_rad = 0;  ///< relative to the plate
  double turn_gain = 0;   ///< how much better a rotated template matches: fraction of the remaining
                          ///< mismatch removed
};

/// A thing on the plate, followed until it is lost or has moved far enough.
struct OnPlateTrack {
  OnPlate thing;
  std::vector<OnPlateSighting> seen = {};

  /// Distance that counts as moving, and distance up to which it is followed.
  double least_px() const;
  double most_px() const;
  double slid_px() const;  ///< at most
};

struct PlateGrains {
  PlateStrip strip;
  std::vector<OnPlateTrack> tracks = {};
  double moved_px = 0;  ///< of the camera, at most, from the scene above the plate
};

/// Everything that stands on the plate when the video begins, followed along it. Reads the video
/// twice, the first time only some frames.
PlateGrains grains_on_plate(const FilmFile& file, const FilmSurvey& survey,
                            const PlateMotion& motion, const FilmProgress& progress);

}  // namespace repose::vision
