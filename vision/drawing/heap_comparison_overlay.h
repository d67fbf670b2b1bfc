#pragma once

#include <array>
#include <string>

#include "vision/compare/heap_comparison.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// What a comparison does not know of itself.
struct ComparisonOverlayNotes {
  std::array<std::string, 2> titles;  ///< the pictures' names
  double margin_rad = 0;              ///< CompareOptions::margin_rad
};

/// Both outlines on the first picture, which is faded: the first heap's as a solid line, the second
/// one's dashed, aligned and in the same scale; a legend below with the numbers and the verdict.
/// Can be read in black and white. Cut to the heaps; white where the first picture ends.
/// @throws base::InputError  the comparison was refused, or the picture has no pixels.
Picture draw_comparison(const Picture& first, const ReposeAngle& first_measured,
                        const HeapComparison& comparison, const ComparisonOverlayNotes& notes);

}  // namespace repose::vision
