#pragma once

#include "vision/measure/likeness.h"
#include "vision/measure/reading.h"

namespace repose::vision {

/// Root mean square distance of another reading's edge from the fitted flanks of one, both on the
/// same ground line, as a part of the one's height.
double edge_distance(const Reading& one, const Reading& other);

/// The reading that the picture supports best, and how far the other good ones are from it.
struct SelectedCandidate {
  Reading best;
  double left_disagreement_rad = 0;  ///< root mean square distance of the other good readings
  double right_disagreement_rad = 0;
  double disagreement_rad = 0;  ///< the same of the mean angle
  HeapPlausibility likeness;    ///< of the best, where it has a flank
};

/// Tries every segmentation, looks again at the best body, and chooses by score.
SelectedCandidate choose_reading(const WorkingPicture& work, const MeasureOptions& options);

}  // namespace repose::vision
