#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

/// When frames were taken, if a film's time stamps are inaccurate.

namespace repose::vision {

/// A camera's steps are even, but a container may round its time stamps: MKV to milliseconds, so
/// that frames 2.08 ms apart seem 2 or 3 ms apart, GIF to hundredths of a second. Stamps that are
/// consistent with rounded even steps, some perhaps missing, become even; others are unchanged.
/// @param unit_s  unit of which the stamps are multiples
std::vector<double> unrounded_times(std::vector<double> stamps_s, double unit_s);

/// The frames' positions on a grid of even steps.
struct FrameGrid {
  double step_s = 0;
  std::vector<double> steps;  ///< steps from the first frame to each; whole numbers
  double off = 0;             ///< root mean square deviation of the stamps, in steps
};

/// std::nullopt for fewer than 8 frames.
std::optional<FrameGrid> grid_of(const std::vector<double>& stamps_s);

/// Where the frame rate changes: in poor light a camera takes fewer frames, and slow motion in a
/// part of a film stretches its time stamps.
struct RateChange {
  std::size_t frame = 0;  ///< the first after which the new rate holds
  double before_s = 0;    ///< between frames
  double after_s = 0;
};

/// Changes by 4 % or more between parts of 8 even steps or more; gaps of a few frames do not count.
std::vector<RateChange> rate_changes(const std::vector<double>& times_s);

/// Frames that show the same as the previous one although something moves: a camera or program that
/// lacked frames repeated some, with even time stamps.
struct RepeatedFrames {
  std::vector<bool> is_repeat;  ///< for each frame; all false if there are too few to be sure
  int count = 0;                ///< found during movement; 0: nothing is repeated
  /// When each frame was taken, in steps between time stamps, if repeats follow the pattern of a
  /// steady camera with a lower rate (25 frames converted to 30: every sixth is a repeat).
  std::optional<std::vector<double>> taken_at = {};
};

/// Compares how much changes from frame to frame. Frames of things at rest are alike too, as are
/// two near the top of a flight: only a frame that hardly changes, between two that change as much
/// as those around them, is a repeat.
class RepeatFinder {
 public:
  /// Takes each frame, in order.
  void look(const cv::Mat& bgr);

  /// @param steps  position of each frame by the time stamps, in whole steps; std::nullopt: they
  ///   are uneven, and no pattern is searched for
  RepeatedFrames repeats(const std::optional<std::vector<double>>& steps) const;

 private:
  cv::Mat before_;
  std::vector<double> changes_;  ///< to each frame: sum of grey levels where most changes
};

/// RepeatFinder's result for the given changes to each frame.
RepeatedFrames repeats_among(const std::vector<double>& changes,
                             const std::optional<std::vector<double>>& steps);

}  // namespace repose::vision
