#pragma once

#include "vision/compare/skyline.h"

namespace repose::vision {

/// How far two upper edges are apart, by the nearest point of the other, not vertically.
struct EdgeDistance {
  double largest = 0;     ///< Hausdorff distance: no point is farther from the other edge
  double most_of_it = 0;  ///< the same for the nearest 95 % of either edge: strays count less
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

}  // namespace repose::vision
