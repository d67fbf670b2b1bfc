#pragma once

#include <array>
#include <vector>

#include "vision/compare/heap_sets.h"
#include "vision/compare/skyline.h"

namespace repose::vision {

/// The mean outlines of two sets, in one unit.
struct MeanOutlines {
  LengthUnit unit = LengthUnit::root_area;
  std::array<MeanOutline, 2> sets;
  std::array<int, 2> left_out = {};  ///< pictures without a whole outline with both flanks
};

/// In metres when every heap has a scale; else each outline is enlarged to the same area.
MeanOutlines mean_outlines(const std::array<const std::vector<SeenHeap>*, 2>& sets);

}  // namespace repose::vision
