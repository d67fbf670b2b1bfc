#pragma once

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Frames of a film of grains on a plate that is tilted until they slide, drawn with the onset
/// angle known exactly.
namespace repose::testing {

struct DrawnTilt {
  int width = 480;
  int height = 360;
  double frames_per_s = 60;
  double rest_s = .5;  ///< before the plate starts to turn
  double rate_deg_s = 3;
  double onset_deg = 22;
  double after_s = .7;       ///< film after the onset
  double slides_with = .85;  ///< kinetic friction / static friction
  double uneven = 0;         ///< relative amplitude of the rate's variation, of period 2 s
  double mm_per_px = .4;
  double radius_px = 9;
  int bonded = 3;          ///< balls side by side
  double hinge_part = .1;  ///< place of the hinge / the picture's width; may lie outside
  double plate_from = 0;   ///< where the plate begins and ends / the picture's width
  double plate_to = .92;
  double grain_part = .45;  ///< middle of the grains / the picture's width
  double thickness_px = 10;
  double edge_row = .72;     ///< row of the level plate's upper edge / the picture's height
  bool has_texture = false;  ///< on the plate
  bool has_shadow = true;
  bool goes_left = false;  ///< mirrored
  double roll_rad = 0;     ///< of the camera, clockwise
  double exposure = .3;    ///< fraction of the frame interval
  double noise = 2;        ///< standard deviation of a grey level
  double rolls = 0;        ///< rotation relative to the plate [rad] per radius travelled; 0: slides
  bool has_spot = false;   ///< makes the rotation visible
  double shakes_px = 0;    ///< amplitude of the camera's shake, of period 2 s
  double creeps_px = 0;    ///< distance crept before the onset
  int grains = 1;          ///< further ones lie lower and slide two degrees earlier
  unsigned seed = 1;

  /// The plate's angle at that time.
  double angle_deg(double time_s) const;
  double onset_s() const;
  int frames() const;
  cv::Mat scene() const;  ///< the static background
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
