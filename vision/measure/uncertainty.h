#pragma once

#include "vision/measure/choice.h"

namespace repose::vision {

/// Half-widths of 95 % intervals [rad].
struct Uncertainty {
  double left_rad = 0;
  double right_rad = 0;
  double mean_rad = 0;
};

/// Combines what can be wrong with an angle, in quadrature:
/// - grains: block bootstrap of the line, times Student's t for the independent stretches of edge;
/// - window: half the largest change when the window is 10-90 % or 30-70 % instead, less what the
///   grains' scatter explains of it; of a bent flank, up to half of its bend, all of that change;
///   both flanks share the choice, so their parts add up;
/// - unseen foot: where the ground line is an edge behind the heap, the window lies too high by an
///   unknown part of it; the flank's bend between the window's halves tells what that may change;
/// - ground line: its tilt, which enters the two sides with opposite sign, so the mean is free of
/// it;
/// - segmentation: how far the other good segmentations are on average, as it is: the best one has
///   earned its place, so the others only bound its error;
/// - a floor for what a single picture cannot show (lens, pixels).
/// An apron is no chance: what counting it in full would change is added to that as it is, so that
/// both readings lie in the interval.
/// Source: JCGM 100:2008 (GUM), 5.1.2 and G.4.1.
Uncertainty uncertainty_of(const SelectedCandidate& choice);
/// Of the best reading's flanks by another definition.
Uncertainty uncertainty_of(const SelectedFlanks& flanks, const Reading& best);

}  // namespace repose::vision
