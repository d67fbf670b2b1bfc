#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/measure/light_steps.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// What a body looks like inside, away from its rim.
struct BodyTexture {
  double noise = 1;     ///< mean step of lightness (L 0 to 100) from pixel to pixel
  double even = 0;      ///< part of the pixels that are as light as the next: 1 in silhouettes but
                        ///< for gaps between the grains
  double straight = 0;  ///< longest straight edge, of the body's height
  double patchy = 0;    ///< part of the body where its colour changes within a tenth of its height:
                        ///< a thing of several parts, not one material
  double aligned = 0;   ///< how far all its edges run one way, 0 to 1: stripes, boards, pleats
  double crossed = 0;   ///< how far they run two ways at right angles: bricks, tiles, weave
  double regular = 0;   ///< part of its pattern that repeats

  /// How its edges run and repeat says nothing then and was not looked at.
  bool is_silhouette() const { return LightSteps{.mean = noise, .even = even}.are_of_silhouette(); }
};

/// @param body           255 where the body is
/// @param crest_height   its height [working px]
/// Proved by BodyTexture.* in tests/vision/body_texture_test.cpp.
BodyTexture texture_of(const cv::Mat1b& body, double crest_height, const WorkingPicture& work);

}  // namespace repose::vision
