#pragma once

#include <optional>
#include <vector>

#include "vision/measure/side_contrast.h"

namespace repose::vision {

/// Roughly a heap's side in a box: from its foot on the ground to its top, straight or bowed a
/// little.
struct RoughFlank {
  double foot = 0;  ///< column
  double top = 0;   ///< column
  double bow = 0;   ///< of the columns between: how much farther inwards it is at half height

  /// Column in which it has a part, 0 to 1, of its height.
  double column(double part) const;
  /// Part of its height that it has in a column, also above 1; below 0 beside the foot.
  double part(double col) const;
};

/// Roughly a heap: where its edge is to be sought.
struct HeapTemplate {
  std::optional<RoughFlank> left;  ///< none: the heap leaves the box on this side
  std::optional<RoughFlank> right;
  double height = 0;  ///< rows above the ground

  /// Height of the lower of both flanks, also above the crest; 0 beside the feet.
  double flank_height(double col) const;
};

/// Of all such heaps the one whose flanks the picture shows best, row by row, over the whole
/// height of the box. No flanks where there are none.
/// @param ground  row of the ground in each column
HeapTemplate best_template(const SideContrast& contrast, const std::vector<int>& ground);

}  // namespace repose::vision
