#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Frames of a film of a ball that rolls down an incline and out onto a flat, drawn with its path
/// known exactly.
namespace repose::testing {

struct DrawnRoll {
  int width = 480;
  int height = 270;
  double frames_per_s = 60;
  double seconds = 2.6;
  double mm_per_px = .8;
  double incline_deg = 20;
  double released_mm = 100;  ///< up the incline, from its foot
  double stopped_mm = 160;   ///< along the flat, from the foot
  double radius_px = 9;
  double release_s = .3;  ///< held until then
  double roll_s = 1.5;    ///< from the release to rest
  double exposure = .3;   ///< fraction of the frame interval
  double noise = 2;       ///< standard deviation of a grey level
  double roll_rad = 0;    ///< of the camera, clockwise
  double hop_px = 0;      ///< how high it hops when it reaches the flat
  bool has_hand = false;  ///< holds the grain, then leaves
  bool has_shadow = true;
  bool goes_left = false;
  int grains = 1;              ///< further ones start lower and stop earlier
  bool has_incline = true;     ///< false: it rolls on the flat only
  double board_square_px = 0;  ///< of a board beside the grain's path; 0: no board
  unsigned seed = 1;

  int frames() const { return static_cast<int>(frames_per_s * seconds); }
  cv::Mat scene() const;  ///< the static background
  vision::Picture picture(int frame, const cv::Mat& scene) const;
};

}  // namespace repose::testing
