#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vision/compare/heap_comparison.h"
#include "vision/measure/flank.h"

/// Heaps represented by their upper edges, with one unit for positions and heights.

namespace repose::vision {

/// A heap's silhouette from the side: everything between the ground and straight lines through
/// points of ascending `along`. Nothing lies beyond the first and the last point.
using Skyline = std::vector<OutlinePoint>;

/// The silhouette moved by -origin along the ground, then scaled.
Skyline placed(const Skyline& skyline, double origin, double factor);

/// The part between `from` and `to`; new points where the lines cross these limits.
Skyline part_of(const Skyline& skyline, double from, double to);

/// 0 outside its ends.
double height_at(const Skyline& skyline, double along);

/// Position along the ground of the centroid of the part between the heights `low` and `high`. NaN
/// if the silhouette does not reach above `low`.
double slab_centre(const Skyline& skyline, double low, double high);

/// Integrals of two heights a and b over a stretch of the ground, exact for straight lines.
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

/// Distance between two upper edges, measured to the nearest point of the other, not vertically.
struct EdgeDistance {
  double largest = 0;     ///< Hausdorff distance: no point is farther from the other edge
  double most_of_it = 0;  ///< the same for the nearest 95 % of either edge: outliers count less
};

/// Each edge is sampled in 2,000 equal steps; the largest distance is exact to within one of them.
///
///     H(A, B) = max(h(A, B), h(B, A)),  h(A, B) = largest (or 95 % quantile) over a in A of the
///     distance from a to the nearest point of B
///
/// Source: Huttenlocher, Klanderman & Rucklidge, IEEE Trans. Pattern Anal. Mach. Intell. 15 (1993)
/// 850-863, sec. 2 and 3 (directed and ranked distances).
/// Both need at least one point. Checked by tests/vision/compare_hausdorff_test.cpp.
EdgeDistance edge_distance(const Skyline& a, const Skyline& b);

/// A measured heap on level ground [px of its picture], not yet aligned with another.
struct StandingHeap {
  Skyline skyline;
  double height = 0;
  double crest = 0;            ///< along the ground
  std::optional<double> axis;  ///< likewise; std::nullopt unless both flanks exist
  Segment ground;

  /// Converts a position on the ground to the picture [px].
  Point on_ground(double along) const;
};

/// Needs a result that was not refused.
StandingHeap standing_heap(const ReposeAngle& measured);

/// How far the two heaps, aligned and in one unit, can be compared.
struct Reach {
  std::array<Coverage, 2> cover = {Coverage::none, Coverage::none};  ///< left, right
  /// Whether the picture's edge cuts off that side: [heap][left, right].
  std::array<std::array<bool, 2>, 2> is_cut = {};

  /// The stretch left (ends at 0) or right (begins at 0) of the axis; empty if cover is none.
  std::array<double, 2> stretch(const Skyline& a, const Skyline& b, Side side) const;
};

Reach reach_of(const ReposeAngle& first, const ReposeAngle& second);

}  // namespace repose::vision
