#pragma once

#include "dem/experiment/experiment.h"
#include "dem/experiment/model_setup.h"

namespace repose::dem {

/// The incline of a roll test: its foot is the y axis, and down it goes +x.
struct Incline {
  Quaternion orientation = Quaternion::Identity();  ///< x down the slope, z away from it
  Vector down = Vector::UnitX();
  Vector normal = Vector::UnitZ();
};

Incline incline_of(const RollProtocol& protocol);

/// Lying on the incline, its long axis across the slope but for the protocol's turn to either side;
/// which end points to the left, the turn and the pose about the long axis are random. The next
/// call with the same numbers is the next release.
Grain released(const ClumpShape& shape, const RollProtocol& protocol, Random& random);

}  // namespace repose::dem
