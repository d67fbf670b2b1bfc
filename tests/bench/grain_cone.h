#pragma once

#include <cstdint>

#include "render/scene/scene.h"

namespace repose::bench {

/// A heap as formed by grains dropped on one spot. Lengths in grain widths.
struct GrainCone {
  double angle_rad = .45;
  double hollow = 1;  ///< exponent on the cone's height / peak: > 1 makes concave flanks
  double grains_high = 20;
  double crest = .15;     ///< height lost by rounding the tip of the sharp cone / height
  double lopsided = .04;  ///< relative amplitude of the base radius' variation
  std::uint64_t seed = 1;
};

/// Radius of its base without the lopsidedness, m.
double base_radius_m(const GrainCone& cone);

/// Nuts on a plate, in as many layers as are visible. Not simulated: they lie as close as in a
/// heap but do not touch as in one.
render::Scene scene_of(const GrainCone& cone);

}  // namespace repose::bench
