#pragma once

#include <vector>

#include "vision/compare/heap_comparison.h"

/// Heaps as their upper edges, in one unit for places and heights.
namespace repose::vision {

/// A heap's silhouette from the side: all between the ground and straight lines through points
/// whose `along` rises. Beyond the first and the last point there is nothing.
using Skyline = std::vector<OutlinePoint>;

/// The silhouette moved by -origin along the ground, then enlarged.
Skyline placed(const Skyline& skyline, double origin, double factor);

/// What lies from `from` to `to`; new points where the lines cross the ends.
Skyline part_of(const Skyline& skyline, double from, double to);

/// 0 beyond its ends.
double height_at(const Skyline& skyline, double along);

/// Where the centre of area lies, along the ground, of what the heights `low` and `high` bound.
/// NaN when the silhouette does not reach above `low`.
double slab_centre(const Skyline& skyline, double low, double high);

/// Sums over a stretch of the ground of two heights a and b, exact for the straight lines.
struct SkylineDifference {
  double length = 0;   ///< of the stretch
  double common = 0;   ///< area of min(a, b)
  double covered = 0;  ///< area of max(a, b)
  double sum = 0;      ///< integral of a - b
  double squares = 0;  ///< integral of (a - b)^2

  SkylineDifference& operator+=(const SkylineDifference& other);
  /// Intersection over union (Jaccard's index) of the two silhouettes.
  double iou() const;
  /// Root mean square of a - b over the stretch.
  double rmse() const;
  /// Mean of a - b over the stretch.
  double mean() const;
};

SkylineDifference difference_of(const Skyline& a, const Skyline& b, double from, double to);

}  // namespace repose::vision
