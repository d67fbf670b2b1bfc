#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "tests/support/heap_grains.h"
#include "tests/support/heap_scene.h"

/// The stage is a 32-bit float BGR matrix of light (linear, 1 = white paper), rows from the top.
namespace repose::testing {

/// sRGB to light.
cv::Vec3f light_of(const Color& color);

struct Stage {
  cv::Size size;
  cv::Mat light;
  double ground_y = 0;   ///< row of the ground line, from the top
  double margin_px = 0;  ///< around the picture
};

/// A stage with nothing painted yet. Its margin is wide enough to keep the corners out of a rotated
/// picture.
Stage empty_stage(const HeapScene& scene);

/// Paints grains in their order, each shaded like an ellipsoid lit from the upper left.
void paint_grains(Stage& stage, const std::vector<Grain>& grains, const GrainLook& look);

/// Black grains, for silhouettes.
void paint_black(Stage& stage, const std::vector<Grain>& grains);

/// Fills the area well inside the outline with the dark colour seen between grains.
void paint_core(Stage& stage, const HeapProfile& profile, const Color& color);

}  // namespace repose::testing
