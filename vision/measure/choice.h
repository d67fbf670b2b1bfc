#pragma once

#include <string_view>
#include <vector>

#include "vision/measure/definitions.h"
#include "vision/measure/likeness.h"
#include "vision/measure/reading.h"

namespace repose::vision {

/// Root mean square distance of the edge of `other` from the fitted flanks of `one`, both on the
/// same ground line, as a fraction of the height of `one`.
double edge_distance(const Reading& one, const Reading& other);

/// Differences of the other good readings from the best one: root mean square.
struct Disagreement {
  double left_rad = 0;
  double right_rad = 0;
  double mean_rad = 0;  ///< of the mean of both sides
};

/// The best reading's flanks by one definition, and how far the others' differ by the same one.
struct SelectedFlanks {
  DefinedFlanks flanks;
  Disagreement disagreement;
};

/// The reading that the picture supports best, and how far the other good ones differ from it.
struct SelectedCandidate {
  Reading best;
  Disagreement disagreement;
  bool is_pointed_at = false;          ///< the user has said where the heap is
  HeapPlausibility likeness;           ///< of the best, if it has a flank
  std::vector<SelectedFlanks> others;  ///< by the definitions other than the default

  /// nullptr if there are none by that definition.
  const SelectedFlanks* by(std::string_view definition) const;
};

/// Tries every segmentation, takes a second look at the best body, and chooses by score.
SelectedCandidate choose_reading(const WorkingPicture& work, const MeasureOptions& options);

}  // namespace repose::vision
