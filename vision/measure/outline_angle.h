#pragma once

#include <optional>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// A known upper edge of a heap, seen from the side: nothing needs to be found in a picture.
/// Lengths in any one unit, such as m or pixels.
struct Outline {
  std::vector<double> along;   ///< ascending, about evenly spaced
  std::vector<double> height;  ///< above the ground line; same size as `along`
};

struct OutlineOptions {
  /// Stretch of the flanks that the lines are fitted to, as fractions of the crest's height.
  double window_from = 0.2;
  double window_to = 0.8;
  /// Grain size in the outline's unit. std::nullopt: estimated from the edge's bumps, as in a
  /// silhouette.
  std::optional<double> grain = {};
  bool has_definitions = false;  ///< also compute the angle by the other definitions
};

/// One side's line.
struct OutlineFlank {
  double angle_rad = 0;
  double foot = 0;  ///< distance from below the crest to where the line meets the ground; at most
                    ///< twice the outline's own
  Segment line;     ///< over its window, in the outline's unit: x along, y the height
};

struct OutlineAngle {
  std::optional<OutlineFlank> left;
  std::optional<OutlineFlank> right;
  std::vector<NamedAngle> definitions = {};  ///< as in ReposeAngle; empty: not requested, or none

  std::optional<double> angle_rad() const;  ///< mean of the sides that exist
};

/// The angle of a heap by the same rules as for pictures: crest, window, apron and line are those
/// of measure_repose_angle(). Its verdict on the picture is replaced by two rules: a line that
/// falls less than 1 in 50 is the top of a layer, not a flank; and a line that would meet the
/// crest's axis at more than three times the crest's height is the edge of a plateau, such as the
/// outermost grain of a layer.
/// Proved by OutlineAngle.* in tests/vision/outline_angle_test.cpp.
/// @throws base::InputError  no points, different numbers of heights and places, places that do not
///   ascend, numbers that are not finite, or a window that MeasureOptions refuses.
OutlineAngle measure_outline(const Outline& outline, const OutlineOptions& options = {});

/// The upper edge of the dark area in a part of a silhouette, over a level ground line, as
/// measure_outline() takes it: binarised half-way between black and white; in each pixel column,
/// the upper side of the highest dark pixel. Whatever is separated from the highest point by a gap
/// of a column or more is left out. Empty if nothing dark lies above the ground.
/// Proved by SilhouetteEdge.* in tests/vision/silhouette_edge_test.cpp.
/// @param part      [px of the picture]; anything dark outside it is ignored
/// @param ground_y  the ground line's row coordinate [px of the picture]
/// @return  along: pixels from the picture's left side; height: pixels above the ground
/// @throws base::InputError  the part does not lie inside the picture.
Outline silhouette_edge(const Picture& silhouette, const Box& part, double ground_y);

}  // namespace repose::vision
