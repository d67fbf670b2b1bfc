#pragma once

#include "vision/measure/outline_angle.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// The upper edge of what is dark in a part of a silhouette, over a level ground line, as
/// measure_outline() takes it: binarised half-way between black and white, and in each pixel column
/// the upper side of the highest dark pixel. What a gap of a column or more parts from the highest
/// place is left out. Empty where nothing dark reaches above the ground.
/// Proved by SilhouetteEdge.* in tests/vision/silhouette_edge_test.cpp.
/// @param part      [px of the picture]; what is dark beyond it is not seen
/// @param ground_y  the ground line's row coordinate [px of the picture]
/// @return  along: pixels from the picture's left side; height: pixels above the ground
/// @throws base::InputError  the part does not lie inside the picture.
Outline silhouette_edge(const Picture& silhouette, const Box& part, double ground_y);

}  // namespace repose::vision
