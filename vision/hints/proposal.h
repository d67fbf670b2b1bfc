#pragma once

#include <optional>

#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// A hint that helps where a picture was refused.
struct Proposal {
  int turn_deg = 0;               ///< turn the picture clockwise first, of kTurns_deg; 0: do not
  std::optional<Box> excluded;    ///< leave this out
  std::optional<Box> heap;        ///< look inside this box alone
  std::optional<Segment> ground;  ///< ... on this line: a first guess, to be corrected
  /// What it then gives; empty where it was not tried, because a person must say where the ground
  /// is.
  std::optional<double> angle_rad;
  std::optional<double> uncertainty_rad;
};

/// Looks for what would help a picture that `options` refused: things laid over it (timers, labels)
/// that may be left out, boxes around what may be the heap, a picture that lies on its side. All
/// are tried, and the most plausible is proposed: one without a flag before one with, then the one
/// whose heap stands out most clearly for the width of its interval. Else the box around the
/// largest thing and its lower side, as a guess for a person to correct. Empty when there is
/// nothing to be seen.
std::optional<Proposal> propose_hint(const Picture& picture, const MeasureOptions& options);

}  // namespace repose::vision
