#pragma once

#include <optional>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// A heap's upper edge that is known, seen from the side: nothing needs to be found in a picture.
/// Lengths in one unit, whichever: m or pixels.
struct Outline {
  std::vector<double> along;   ///< ascending, about evenly spaced
  std::vector<double> height;  ///< above the ground line; as many as `along`
};

struct OutlineOptions {
  /// Stretch of the flanks the lines are fitted to, as fractions of the crest's height.
  double window_from = 0.2;
  double window_to = 0.8;
  /// A grain's size in the outline's unit. Empty: read off the edge's bumps, as in a silhouette.
  std::optional<double> grain = {};
  bool has_definitions = false;  ///< the angle by other definitions is asked for, too
};

/// One side's line.
struct OutlineFlank {
  double angle_rad = 0;
  double foot = 0;  ///< from below the crest to where the line meets the ground; at most twice as
                    ///< far as the outline reaches
  Segment line;     ///< over its window, in the outline's unit: x along, y the height
};

struct OutlineAngle {
  std::optional<OutlineFlank> left;
  std::optional<OutlineFlank> right;
  std::vector<NamedAngle> definitions = {};  ///< as ReposeAngle's; empty: not asked for, or none

  std::optional<double> angle_rad() const;  ///< mean of the sides that exist
};

/// The angle of a heap by the rules that pictures are measured with: crest, window, apron and line
/// are those of measure_repose_angle(). Its verdict on what was seen is replaced by two rules: a
/// line that falls less than 1 in 50 is no flank but a layer's top, nor is one that would meet the
/// crest's axis higher than three times the crest, which is the edge of a plateau, such as the
/// outermost grain of a layer.
/// Proved by OutlineAngle.* in tests/vision/outline_angle_test.cpp.
/// @throws base::InputError  no points, not as many heights as places, places that do not
///   ascend, numbers that are not finite, or a window that MeasureOptions refuses.
OutlineAngle measure_outline(const Outline& outline, const OutlineOptions& options = {});

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
