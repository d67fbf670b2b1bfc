#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Frames of a film of grains on a plate that is tilted until they slide, drawn with the angle of
/// the onset known.
namespace repose::testing {

struct DrawnTilt {
  int width = 480;
  int height = 360;
  double frames_per_s = 60;
  double rest_s = .5;  ///< the plate lies still before it turns
  double rate_deg_s = 3;
  double onset_deg = 22;
  double after_s = .7;       ///< film after the onset
  double slides_with = .85;  ///< friction in motion over friction at rest
  double uneven = 0;         ///< the rate goes up and down by this part of it, once in 2 s
  double mm_per_px = .4;
  double radius_px = 9;
  int bonded = 3;          ///< balls side by side
  double hinge_part = .1;  ///< of the picture's width, where the hinge is; may lie outside
  double plate_from = 0;   ///< of the picture's width, where the plate begins and ends
  double plate_to = .92;
  double grain_part = .45;  ///< of the picture's width, the middle of the grains
  double thickness_px = 10;
  double edge_row = .72;     ///< of the picture's height, of the level plate's upper edge
  bool has_texture = false;  ///< on the plate
  bool has_shadow = true;
  bool goes_left = false;  ///< mirrored
  double roll_rad = 0;     ///< of the camera, clockwise
  double exposure = .3;    ///< of the time between frames
  double noise = 2;        ///< standard deviation of a grey level
  double rolls = 0;        ///< turns against the plate per radius of its way; 0: slides
  bool has_spot = false;   ///< shows how it turns
  double shakes_px = 0;    ///< the camera, once in 2 s
  double creeps_px = 0;    ///< before the onset
  int grains = 1;          ///< further ones lie lower and slide two degrees earlier
  unsigned seed = 1;

  /// The plate's angle at a time.
  double angle_deg(double time_s) const;
  double onset_s() const;
  int frames() const;
  cv::Mat scene() const;  ///< what stands still
  vision::Picture picture(int frame, const cv::Mat& scene) const;
};

/// Small and short: quick to draw and to read.
inline DrawnTilt small_tilt() {
  return {.width = 240,
          .height = 140,
          .frames_per_s = 30,
          .rest_s = .3,
          .rate_deg_s = 6,
          .onset_deg = 11,
          .after_s = .4,
          .mm_per_px = .8,
          .radius_px = 6,
          .thickness_px = 6};
}

}  // namespace repose::testing
