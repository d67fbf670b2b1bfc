#pragma once

#include <array>
#include <string>

#include "vision/compare/heap_sets.h"
#include "vision/picture/picture.h"

namespace repose::vision {

inline constexpr int kSetsFigure_px = 1400;

/// What the comparison of sets itself does not contain.
struct HeapSetsNotes {
  std::array<std::string, 2> titles;  ///< names of the sets
  double margin_rad = 0;
  int width_px = kSetsFigure_px;  ///< letters and lines scale with it
};

/// The mean outlines of two sets at the same scale, the first solid, the second dashed, each with
/// the band that contains 80 % of its pictures; below, every heap's angle with both means and their
/// 95 % intervals; then the numbers and the verdict. Legible in black and white.
/// @throws base::InputError  no set has an outline or an angle.
Picture draw_heap_sets(const SetComparison& comparison, const HeapSetsNotes& notes);

}  // namespace repose::vision
