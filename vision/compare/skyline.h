#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vision/compare/heap_comparison.h"
#include "vision/measure/flank.h"

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

/// How far two upper edges are apart, by the nearest point of the other, not vertically.
struct EdgeDistance {
  double largest = 0;  ///< Hausdorff distance: no point is farther from the other edge
  double most_of_it =
      0;  ///< the same for the nearest 95 % of either edge: loose_particles count less
};

/// Both edges are followed in 2,000 equal steps; the largest distance is exact to one of them.
///
///     H(A, B) = max(h(A, B), h(B, A)),  h(A, B) = largest (or 95 % quantile) over a in A of the
///     distance from a to the nearest point of B
///
/// Source: Huttenlocher, Klanderman & Rucklidge, IEEE Trans. Pattern Anal. Mach. Intell. 15 (1993)
/// 850-863, sec. 2 and 3 (directed and ranked distances).
/// Both need a point. Checked by tests/vision/compare_hausdorff_test.cpp.
EdgeDistance edge_distance(const Skyline& a, const Skyline& b);

/// A measured heap on level ground [px of its picture], not yet aligned with another one.
struct StandingHeap {
  Skyline skyline;
  double height = 0;
  double crest = 0;            ///< along the ground
  std::optional<double> axis;  ///< likewise; empty unless both flanks are there
  Segment ground;

  /// Point of the picture that lies there on the ground [px].
  Point on_ground(double along) const;
};

/// Needs a result that is not refused.
StandingHeap standing_heap(const ReposeAngle& measured);

/// How far the two heaps, aligned and in one unit, can be compared.
struct Reach {
  std::array<Coverage, 2> cover = {Coverage::none, Coverage::none};  ///< left, right
  /// Whether the picture's edge cuts off that side: [heap][left, right].
  std::array<std::array<bool, 2>, 2> is_cut = {};

  /// The stretch left (ends at 0) or right (begins at 0) of the axis; empty where cover is none.
  std::array<double, 2> stretch(const Skyline& a, const Skyline& b, Side side) const;
};

Reach reach_of(const ReposeAngle& first, const ReposeAngle& second);

}  // namespace repose::vision
