#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vision/measure/reading.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// How lightness changes to the next pixel: whether there is a pattern to look for.
struct LightSteps {
  double mean = 0;
  double even = 0;  ///< part of the steps that are none; 0 where there are no pixels

  /// All of one lightness but for gaps between the grains; all else shows grains, whose light and
  /// dark are not smooth.
  bool is_silhouette() const { return even > 0.985; }
};

/// @param lightness  L, 0 to 100
LightSteps light_steps(const cv::Mat1f& lightness, const cv::Mat1b& inside);

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
  bool is_silhouette() const { return LightSteps{.mean = noise, .even = even}.is_silhouette(); }
};

/// @param body           255 where the body is
/// @param crest_height   its height [working px]
/// Proved by BodyTexture.* in tests/vision/body_texture_test.cpp.
BodyTexture texture_of(const cv::Mat1b& body, double crest_height, const WorkingPicture& work);

/// What tells a heap of grains from other things that stand on the ground and have sloping sides.
struct HeapPlausibility {
  double filled = 1;     ///< part of what is under the upper edge that belongs to the body: legs,
                         ///< wheels and branches leave gaps
  double climb = 0;      ///< by how much the smoothed edge rises again on its way down from the
                         ///< crest, of the crest's height; the larger of the two sides
  double rough_px = 1;   ///< standard deviation of the fitted edge about its own moving average
                         ///< [working px]; of the rougher side
  double level = 0;      ///< part of the fitted edge that is level; of the more level side
  double sharpness = 1;  ///< of the edge (Reading::edge_sharpness): a blurred one is less rough
  BodyTexture inside;
};

/// Of a reading that has a flank.
HeapPlausibility likeness_of(const Reading& reading, const WorkingPicture& work);

/// Why it may be no heap; empty when nothing speaks against it. The limits lie where
/// drawn, rendered and real heaps pass and ninety-nine of a hundred other things do not.
/// Proved by HeapPlausibility.* in tests/vision/likeness_test.cpp; tests/bench/photo_accuracy
/// counts both.
/// @param grain  size that the body's pattern shows [working px]; empty: no pattern
std::string reason_against_heap(const HeapPlausibility& likeness, std::optional<double> grain);

}  // namespace repose::vision
