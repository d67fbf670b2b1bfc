#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// The incline of a roll test: its foot is the y axis, and down it goes +x.
struct Incline {
  Quaternion orientation = Quaternion::Identity();  ///< x down the slope, z away from it
  Vector down = Vector::UnitX();
  Vector normal = Vector::UnitZ();
};

Incline incline_of(const RollProtocol& protocol);

/// Lying on the incline, turned at random about the incline's normal and about its own long axis.
Grain released(const ClumpShape& shape, const RollProtocol& protocol, std::uint64_t seed);

}  // namespace repose::dem
