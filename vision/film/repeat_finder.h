#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace repose::vision {

/// Frames that show what the one before them shows, while something moves: a camera or a program
/// that needed more frames than it had repeated some, behind time stamps that are even.
struct RepeatedFrames {
  std::vector<bool> is_repeat;  ///< of each frame; none is true where too few are to be sure
  int count = 0;                ///< seen while something moves; 0: nothing is repeated
  /// When each frame was taken, in steps between time stamps, where they are repeated in a pattern
  /// that a steady camera of a lower rate leaves (25 frames made 30 have every sixth repeated).
  std::optional<std::vector<double>> taken_at = {};
};

/// Looks at how much changes from frame to frame. Frames of things at rest are alike too, as are
/// two about the top of a flight: only one that hardly changes between two that change as much as
/// those around them is a repeat.
class RepeatFinder {
 public:
  /// Each frame, in their order.
  void look(const cv::Mat& bgr);

  /// @param steps  at which each frame is by the time stamps, in whole steps; none: those are not
  ///   even, and no pattern is looked for
  RepeatedFrames repeats(const std::optional<std::vector<double>>& steps) const;

 private:
  cv::Mat before_;
  std::vector<double> changes_;  ///< to each frame, where most changes: sum of grey levels
};

/// As RepeatFinder has it, of the changes to each frame.
RepeatedFrames repeats_among(const std::vector<double>& changes,
                             const std::optional<std::vector<double>>& steps);

}  // namespace repose::vision
