#pragma once

#include <string>
#include <vector>

namespace repose::bench {

/// The sample's heap, filled, lifted and settled: here, in LIGGGHTS, and its pictures.
struct HeapTimes {
  std::vector<double> ours_s;    ///< CPU time
  std::vector<double> theirs_s;  ///< CPU time
  std::vector<double> views_s;   ///< CPU time of drawing and measuring our heap from 18 sides
  int grains = 0;
};

/// Runs both, turn about. LIGGGHTS runs the exported deck, in steps of .175 of the stable one (ours
/// are up to .3): the same clump, materials and rolling friction, its own fill from a loose column,
/// and then as many seconds as ours took from the lift to rest.
/// @param settings  of the study, as "experiment.heap.grains=100"
HeapTimes race_heaps(const std::vector<std::string>& settings, int rounds);

}  // namespace repose::bench
