#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

/// When frames were taken, where a film's time stamps do not say it well.

namespace repose::vision {

/// A camera's steps are even; a container may round its time stamps: MKV to milliseconds, so that
/// frames 2.08 ms apart seem 2 or 3 ms apart, GIF to hundredths of a second. Stamps that are what
/// rounding makes of even steps, some of them left out, become even; others stay as they are.
/// @param unit_s  what they are multiples of
std::vector<double> unrounded_times(std::vector<double> stamps_s, double unit_s);

/// As many steps of the median length, from 0 on, as lie between frames.
struct FrameGrid {
  double step_s = 0;
  std::vector<double> steps;  ///< at each frame, from the first one on; whole numbers
  double off = 0;             ///< of the stamps, root mean square, in steps
};

/// None of fewer than 8 frames.
std::optional<FrameGrid> grid_of(const std::vector<double>& stamps_s);

/// Where frames begin to follow each other faster or more slowly: in poor light a camera takes
/// fewer, and slow motion in a part of a film stretches its time stamps.
struct RateChange {
  std::size_t frame = 0;  ///< the first that others follow at the new rate
  double before_s = 0;    ///< between frames
  double after_s = 0;
};

/// Changes by 4 % or more between parts of 8 even steps or more; gaps of some frames are none.
std::vector<RateChange> rate_changes(const std::vector<double>& times_s);

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
