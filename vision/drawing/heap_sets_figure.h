#pragma once

#include <array>
#include <string>

#include "vision/compare/heap_sets.h"
#include "vision/picture/picture.h"

namespace repose::vision {

inline constexpr int kSetsFigure_px = 1400;

/// What a comparison of sets does not know of itself.
struct HeapSetsNotes {
  std::array<std::string, 2> titles;  ///< the sets' names
  double margin_rad = 0;
  int width_px = kSetsFigure_px;  ///< letters and lines grow with it
};

/// The mean outlines of two sets in one scale, the first solid, the second dashed, each with the
/// band in which 80 % of its pictures lie; below it every heap's angle with both means and their
/// 95 % intervals; then the numbers and the verdict. Can be read in black and white.
/// @throws base::InputError  no set has an outline or an angle.
Picture draw_heap_sets(const SetComparison& comparison, const HeapSetsNotes& notes);

}  // namespace repose::vision
