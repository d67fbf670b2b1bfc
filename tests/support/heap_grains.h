#pragma once

#include <vector>

#include "tests/support/heap_profile.h"
#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"
#include "vision/picture/picture.h"

namespace repose::testing {

/// An ellipse with the shading of an ellipsoid. y is up from the ground, in px of the stage.
struct Grain {
  vision::Point center;
  double long_axis = 0;   ///< half of it
  double short_axis = 0;  ///< half of it
  double turn_rad = 0;
  Color color;
  double order = 0;  ///< larger is farther from the camera

  /// Distance from the centre to the tangent with this unit normal.
  double support(vision::Point normal) const;
  /// Upper edge at column x; 0 beside the grain.
  double top_at(double x) const;
};

/// The heap's grains, the farthest from the camera first.
///
/// Grains of the outline touch the profile from below, so that their envelope follows it without
/// bias; the others lie wholly inside.
std::vector<Grain> heap_grains(const HeapScene& scene, const HeapProfile& profile,
                               double stage_width_px, Random& random);

/// Grains lying on the ground beside the heap.
std::vector<Grain> stray_grains(const HeapScene& scene, const HeapProfile& profile,
                                double stage_width_px, Random& random);

/// Upper envelope of the grains at every half pixel from the first to the last grain.
std::vector<vision::Point> envelope(const std::vector<Grain>& grains);

}  // namespace repose::testing
