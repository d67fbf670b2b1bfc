#pragma once

#include <cstdint>

#include "render/scene/scene.h"

namespace repose::bench {

/// A heap as grains make it that are let fall on one spot. Lengths in grains' widths.
struct GrainCone {
  double angle_rad = .45;
  double hollow = 1;  ///< exponent on the cone's height / peak: above 1 its flanks are hollow
  double grains_high = 20;
  double crest = .15;     ///< height that the rounded tip lacks to the cone's / height
  double lopsided = .04;  ///< how much farther it reaches on one side than on the other
  std::uint64_t seed = 1;
};

/// Its base's radius without the lopsidedness, m.
double base_radius_m(const GrainCone& cone);

/// Nuts on a plate, as many layers of them as can be seen into. No simulation made them: they are
/// near each other as in a heap but do not touch as there.
render::Scene scene_of(const GrainCone& cone);

}  // namespace repose::bench
