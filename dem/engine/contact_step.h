#pragma once

#include "dem/engine/bodies.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// What the contacts of one step depend on: where bodies and walls are, the contact laws, the time
/// step.
struct ContactStep {
  const Bodies& bodies;
  const WallSet& walls;
  const ContactTable& contacts;
  double timestep_s;

  int material(int body) const { return bodies.material[static_cast<std::size_t>(body)]; }
};

}  // namespace repose::dem
