#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// A heap's upper edge, seen level from one side: the highest point of its grains in each upright
/// column of the picture plane.
struct HeapEnvelope {
  double azimuth_rad = 0;        ///< 0 looks along +y; rises counter-clockwise, seen from above
  double column_m = 0;           ///< from one column to the next
  std::vector<double> height_m;  ///< of the columns above the ground, left to right; all above 0
};

/// The envelopes of a heap of spheres on the ground z = 0 from `views` sides, equally spaced over
/// half a turn; the first looks along +y.
///
/// Columns are a twentieth of a mean sphere's radius wide. The heap is what is connected with the
/// highest column: grains beyond a gap are not part of it. Proved by HeapEnvelope.* in
/// tests/dem/experiment_envelope_test.cpp.
///
/// Throws base::InputError for less than one view and where no sphere reaches above the
/// ground.
std::vector<HeapEnvelope> heap_envelopes(const std::vector<ClumpSphere>& spheres, int views);

/// Heaps lower than this many grain diameters are layers, which have no angle of repose.
inline constexpr double kLowestHeap = 2.5;

/// The highest point of all envelopes, m.
double height_m(const std::vector<HeapEnvelope>& envelopes);

}  // namespace repose::dem
