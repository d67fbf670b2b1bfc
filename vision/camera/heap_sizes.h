#pragma once

#include <optional>
#include <string>

#include "vision/measure/scale_bar.h"

namespace repose::vision {

/// A heap's size. Its middle plane is the upright plane through its axis that faces the camera; its
/// ground is level. Missing sizes are std::nullopt.
struct HeapSizes {
  std::string reason;                        ///< why there are none
  std::optional<Estimate> mm_per_px;         ///< in the middle plane, where the heap stands
  std::optional<Estimate> height_mm;         ///< of the crest above the ground
  std::optional<Estimate> base_mm;           ///< from foot to foot; needs both feet
  std::optional<Estimate> cone_volume_ml;    ///< of a cone with that height and base
  std::optional<Estimate> left_run_out_mm;   ///< from below the crest to the foot
  std::optional<Estimate> right_run_out_mm;  ///< likewise
};

/// Volume of a cone, ml.
///
///     V = pi d^2 h / 12
///
///     d   base_mm     mm
///     h   height_mm   mm
///
/// Proved by tests/vision/sized_heap_test.cpp.
double cone_volume_ml(double base_mm, double height_mm);

}  // namespace repose::vision
