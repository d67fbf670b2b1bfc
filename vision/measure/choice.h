#pragma once

#include <string_view>
#include <vector>

#include "vision/measure/definitions.h"
#include "vision/measure/likeness.h"
#include "vision/measure/reading.h"

namespace repose::vision {

/// Root mean square distance of another reading's edge from the fitted flanks of one, both on the
/// same ground line, as a part of the one's height.
double edge_distance(const Reading& one, const Reading& other);

/// How far the other good readings are from the best one: root mean square distances.
struct Disagreement {
  double left_rad = 0;
  double right_rad = 0;
  double mean_rad = 0;  ///< of the mean of both sides
};

/// The best reading's flanks by a definition, and those of the others by the same.
struct SelectedFlanks {
  DefinedFlanks flanks;
  Disagreement disagreement;
};

/// The reading that the picture supports best, and how far the other good ones are from it.
struct SelectedCandidate {
  Reading best;
  Disagreement disagreement;
  bool is_pointed_at = false;          ///< a person has said where the heap is
  HeapPlausibility likeness;           ///< of the best, where it has a flank
  std::vector<SelectedFlanks> others;  ///< by the definitions other than the usual one

  /// Null where there are none by that.
  const SelectedFlanks* by(std::string_view definition) const;
};

/// Tries every segmentation, looks again at the best body, and chooses by score.
SelectedCandidate choose_reading(const WorkingPicture& work, const MeasureOptions& options);

}  // namespace repose::vision
