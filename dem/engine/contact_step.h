#pragma once

#include <vector>

#include "dem/engine/bodies.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// What the contacts of one step depend on: where the bodies and walls are, and what rules.
struct ContactStep {
  const Bodies& bodies;
  const WallSet& walls;
  const ContactTable& contacts;
  const std::vector<GrainKind>& kinds;
  double timestep_s;

  int material(int body) const {
    const int kind = bodies.kind[static_cast<std::size_t>(body)];
    return kinds[static_cast<std::size_t>(kind)].material;
  }
};

}  // namespace repose::dem
