#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

}  // namespace repose::vision
