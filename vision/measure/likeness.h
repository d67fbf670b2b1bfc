#pragma once

#include <optional>
#include <string>

#include "vision/measure/body_texture.h"
#include "vision/measure/reading.h"

namespace repose::vision {

/// What tells a heap of grains from other things that stand on the ground and have sloping sides.
struct Likeness {
  double filled = 1;     ///< part of what is under the upper edge that belongs to the body: legs,
                         ///< wheels and branches leave gaps
  double climb = 0;      ///< by how much the smoothed edge rises again on its way down from the
                         ///< crest, of the crest's height; the larger of the two sides
  double rough_px = 1;   ///< standard deviation of the fitted edge about its own moving average
                         ///< [working px]; of the rougher side
  double level = 0;      ///< part of the fitted edge that is level; of the more level side
  double sharpness = 1;  ///< of the edge (Reading::edge_sharpness): a blurred one is less rough
  BodyTexture inside;
};

/// Of a reading that has a flank.
Likeness likeness_of(const Reading& reading, const WorkingPicture& work);

/// Why it may be no heap; empty when nothing speaks against it. The limits lie where
/// drawn, rendered and real heaps pass and ninety-nine of a hundred other things do not.
/// Proved by Likeness.* in tests/vision/likeness_test.cpp; tests/bench/photo_accuracy counts both.
/// @param grain  size that the body's pattern shows [working px]; empty: no pattern
std::string reason_against_heap(const Likeness& likeness, std::optional<double> grain);

}  // namespace repose::vision
