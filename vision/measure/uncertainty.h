#pragma once

#include "vision/measure/choice.h"

namespace repose::vision {

/// Half-widths of 95 % intervals [rad].
struct Uncertainty {
  double left_rad = 0;
  double right_rad = 0;
  double mean_rad = 0;
};

/// Combines the sources of error of an angle, in quadrature:
/// - grains: block bootstrap of the line, times Student's t for the independent stretches of edge;
/// - window: half the largest change when the window is 10-90 % or 30-70 % instead, less what the
///   grains' scatter explains of it; if the flank is bent, all of that change, up to half of its
///   bend; both flanks share the choice, so their parts add up;
/// - unseen foot: if the ground line is an edge behind the heap, the window lies too high by an
///   unknown amount; the flank's bend between the window's halves shows what that may change;
/// - ground line: its tilt, which enters the two sides with opposite sign, so it cancels in the
///   mean;
/// - segmentation: the rms difference of the other good segmentations, without a coverage factor:
///   the best one was chosen on merit, so the others only bound its error;
/// - a floor for what a single picture cannot show (lens, pixels).
/// An apron is not random: the change if it had full weight is added linearly, so that both
/// readings lie in the interval.
/// Source: JCGM 100:2008 (GUM), 5.1.2 and G.4.1.
Uncertainty uncertainty_of(const SelectedCandidate& choice);
/// For the flanks of the best reading by another definition.
Uncertainty uncertainty_of(const SelectedFlanks& flanks, const Reading& best);

}  // namespace repose::vision
