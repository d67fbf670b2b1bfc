#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Frames of a film of a grain that falls and bounces, drawn with its path known exactly.
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
  double exposure = .3;       ///< fraction of the frame interval
  double noise = 2;           ///< standard deviation of a grey level
  double readout_s = 0;       ///< from the first row to the last
  double roll_rad = 0;        ///< of the camera, clockwise
  double shake_px = 0;        ///< of the camera
  bool has_hand = false;      ///< holds the grain, then leaves
  bool has_shadow = true;
  int grains = 1;              ///< side by side
  int cut = -1;                ///< first frame of another scene; < 0: no cut
  double board_square_px = 0;  ///< of a board beside the grain's path; 0: no board
  unsigned seed = 1;

  int frames() const { return static_cast<int>(frames_per_s * seconds); }
  /// Height of the grain's centre above its position at an impact [mm].
  double height_mm(double time_s) const;
  cv::Mat scene() const;  ///< the static background
  vision::Picture picture(int frame, const cv::Mat& scene) const;
};

}  // namespace repose::testing
