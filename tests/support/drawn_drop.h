#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Frames of a film of a grain that falls and bounces, drawn with everything about its path known.
namespace repose::testing {

struct DrawnDrop {
  int width = 480;
  int height = 360;
  double frames_per_s = 60;  ///< as the camera takes them
  double seconds = 2;
  double mm_per_px = 1;
  double drop_mm = 250;
  double restitution = .6;
  double radius_px = 9;
  double release_s = .3;      ///< held until then
  double sideways_px_s = 12;  ///< after the release
  double exposure = .3;       ///< of the time between frames
  double noise = 2;           ///< standard deviation of a grey level
  double readout_s = 0;       ///< from the first row to the last
  double roll_rad = 0;        ///< of the camera, clockwise
  double shake_px = 0;        ///< of the camera
  bool has_hand = false;      ///< holds the grain, then leaves
  bool has_shadow = true;
  int grains = 1;              ///< beside each other
  int cut = -1;                ///< frame from which on another scene is seen
  double board_square_px = 0;  ///< of a board beside the grain's way; 0: there is none
  unsigned seed = 1;

  int frames() const { return static_cast<int>(frames_per_s * seconds); }
  /// Height of the grain's centre above where it is at an impact [mm].
  double height_mm(double time_s) const;
  cv::Mat scene() const;  ///< what stands still
  vision::Picture picture(int frame, const cv::Mat& scene) const;
};

}  // namespace repose::testing
