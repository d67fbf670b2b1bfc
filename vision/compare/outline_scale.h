#pragma once

#include <array>

#include "vision/compare/placed_heap.h"

namespace repose::vision {

struct OutlineScale {
  LengthUnit unit = LengthUnit::root_area;
  std::array<double, 2> unit_per_px = {};
};

/// The given scales; else equal areas of what is compared; else, where a foot is out of the frame
/// or no side is in both pictures, equal heights. `skylines` are aligned, in px.
OutlineScale outline_scale(const std::array<const ReposeAngle*, 2>& measured,
                           const std::array<Skyline, 2>& skylines, const Reach& reach,
                           const CompareOptions& options);

}  // namespace repose::vision
