#pragma once

#include <array>
#include <string>

#include "vision/compare/heap_comparison.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// What the comparison itself does not contain.
struct ComparisonOverlayNotes {
  std::array<std::string, 2> titles;  ///< names of the pictures
  double margin_rad = 0;              ///< CompareOptions::margin_rad
};

/// Both outlines on the faded first picture, the first heap's solid, the second one's dashed,
/// aligned and at the same scale; below, a legend with the numbers and the verdict. Legible in
/// black and white. Cropped to the heaps; white beyond the first picture.
/// @throws base::InputError  the comparison was refused, or the picture has no pixels.
Picture draw_comparison(const Picture& first, const ReposeAngle& first_measured,
                        const HeapComparison& comparison, const ComparisonOverlayNotes& notes);

}  // namespace repose::vision
