#pragma once

#include "vision/measure/likeness.h"
#include "vision/measure/reading.h"

namespace repose::vision {

/// The reading that the picture supports best, and how far the other good ones are from it.
struct Choice {
  Reading best;
  double left_disagreement_rad = 0;  ///< root mean square distance of the other good readings
  double right_disagreement_rad = 0;
  double disagreement_rad = 0;  ///< the same of the mean angle
  Likeness likeness;            ///< of the best, where it has a flank
};

/// Tries every segmentation, looks again at the best body, and chooses by score.
Choice choose_reading(const WorkingPicture& work, const MeasureOptions& options);

}  // namespace repose::vision
