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
  double elongation = 1;      ///< its length over its breadth; 1: round
  bool touches_edge = false;  ///< not all of it is seen
};

/// Where it is in one frame.
struct OnPlateSighting {
  std::size_t plate = 0;  ///< number in PlateMotion::seen
  double time_s = 0;
  double slid_px = 0;     ///< down the plate, from where it lay
  double rise_px = 0;     ///< off the plate
  double turned_rad = 0;  ///< against the plate
  double turn_gain = 0;   ///< how much better it is found turned: part of what is else unlike
};

/// A thing on the plate that is followed until it is lost or has gone far enough.
struct OnPlateTrack {
  OnPlate thing;
  std::vector<OnPlateSighting> seen = {};

  /// How far it must go to count as moving, and how far it is followed.
  double least_px() const;
  double most_px() const;
  double slid_px() const;  ///< at most
};

struct PlateGrains {
  PlateStrip strip;
  std::vector<OnPlateTrack> tracks = {};
  double moved_px = 0;  ///< of the camera, at most, by the scene above the plate
};

/// All that stands on the plate when the film begins, followed along it. Looks through the film
/// twice, the first time at some frames only.
PlateGrains grains_on_plate(const FilmFile& file, const FilmSurvey& survey,
                            const PlateMotion& motion, const FilmProgress& progress);

}  // namespace repose::vision
