#pragma once

#include <string>
#include <vector>

namespace repose::bench {

/// Times of the sample's heap, filled, lifted and settled: in repose, in LIGGGHTS, and of its
/// views.
struct HeapTimes {
  std::vector<double> ours_s;    ///< CPU time
  std::vector<double> theirs_s;  ///< CPU time
  std::vector<double> views_s;   ///< CPU time of drawing and measuring our heap from 18 sides
  int grains = 0;
};

/// Runs both alternately. LIGGGHTS runs the exported deck in steps of .175 of the stable one (ours
/// are up to .3): the same clump, materials and rolling friction, its own filling from a loose
/// column, and then until its heap is at rest.
/// @param settings  of the study, e.g. "experiment.heap.grains=100"
HeapTimes race_heaps(const std::vector<std::string>& settings, int rounds);

}  // namespace repose::bench
