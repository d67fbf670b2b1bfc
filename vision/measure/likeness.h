#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vision/measure/reading.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// Steps in lightness between neighbouring pixels: whether there is a pattern to look for.
struct LightSteps {
  double mean = 0;
  double even = 0;  ///< fraction of steps that are zero; 0 if there are no pixels

  /// Of uniform lightness except for gaps between the grains; otherwise grains are visible, whose
  /// light and dark areas are not smooth.
  bool is_silhouette() const { return even > 0.985; }
};

/// @param lightness  L, 0 to 100
LightSteps light_steps(const cv::Mat1f& lightness, const cv::Mat1b& inside);

/// What a body looks like inside, away from its rim.
struct BodyTexture {
  double noise = 1;  ///< mean step of lightness (L 0 to 100) from pixel to pixel
  double even = 0;  ///< fraction of pixels as light as their neighbour: 1 in silhouettes except for
                    ///< gaps between the grains
  double straight = 0;  ///< longest straight edge, as a fraction of the crest's height
  double patchy = 0;    ///< fraction of the body where the colour changes within a tenth of its
                        ///< height: an object of several parts, not one material
  double aligned = 0;   ///< how far all edges run in one direction, 0 to 1: stripes, boards, pleats
  double crossed = 0;   ///< how far they run in two perpendicular directions: bricks, tiles, weave
  double regular = 0;   ///< fraction of the pattern's power that repeats

  /// In that case the direction and repetition of its edges mean nothing and were not examined.
  bool is_silhouette() const { return LightSteps{.mean = noise, .even = even}.is_silhouette(); }
};

/// @param body           255 inside the body
/// @param crest_height   its height [working px]
/// Proved by BodyTexture.* in tests/vision/body_texture_test.cpp.
BodyTexture texture_of(const cv::Mat1b& body, double crest_height, const WorkingPicture& work);

/// What distinguishes a heap of grains from other things that stand on the ground with sloping
/// sides.
struct HeapPlausibility {
  double filled = 1;  ///< fraction of the area under the upper edge that belongs to the body: legs,
                      ///< wheels and branches leave gaps
  double climb = 0;  ///< how far the smoothed edge rises again on its way down from the crest, as a
                     ///< fraction of the crest's height; the larger of the two sides
  double rough_px = 1;   ///< standard deviation of the fitted edge about its own moving average
                         ///< [working px]; of the rougher side
  double level = 0;      ///< fraction of the fitted edge that is level; of the more level side
  double sharpness = 1;  ///< of the edge (Reading::edge_sharpness): a blurred one is less rough
  BodyTexture inside;
};

/// For a reading that has a flank.
HeapPlausibility likeness_of(const Reading& reading, const WorkingPicture& work);

/// Why it may not be a heap; empty if nothing speaks against it. The limits are set so that drawn,
/// rendered and real heaps pass and ninety-nine of a hundred other objects do not.
/// Proved by HeapPlausibility.* in tests/vision/likeness_test.cpp; tests/bench/photo_accuracy
/// counts both.
/// @param grain  size from the body's pattern [working px]; std::nullopt: no pattern
std::string reason_against_heap(const HeapPlausibility& likeness, std::optional<double> grain);

}  // namespace repose::vision
