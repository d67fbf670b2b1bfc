#pragma once

#include <optional>

#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// A hint that may make a refused picture measurable.
struct Proposal {
  int turn_deg = 0;               ///< turn clockwise first, one of kTurns_deg; 0: no turn
  std::optional<Box> excluded;    ///< ignore this
  std::optional<Box> heap;        ///< look only inside this box
  std::optional<Segment> ground;  ///< with the ground on this line: a first guess, to be corrected
  /// The result with this hint; std::nullopt if it was not tried because the user must mark the
  /// ground.
  std::optional<double> angle_rad;
  std::optional<double> uncertainty_rad;
};

/// Looks for a hint that helps with a picture that was refused with `options`: overlaid timers or
/// labels to exclude, boxes around possible heaps, a picture that lies on its side. All are tried,
/// and the most plausible is proposed: unflagged results before flagged ones, then the one with the
/// highest confidence relative to the width of its interval. Otherwise the box around the largest
/// object with its lower side as ground, as a guess for the user to correct. std::nullopt if
/// nothing was found.
std::optional<Proposal> propose_hint(const Picture& picture, const MeasureOptions& options);

}  // namespace repose::vision
