#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/line_fit.h"
#include "vision/measure/profile.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

enum class Side { left, right };

/// A line that falls less than this is level: where it has the window's heights says nothing.
inline constexpr double kFlattestSlope = 0.02;

/// One side of the heap, fitted. Lengths in working pixels, along and above the ground line.
struct FlankFit {
  FlankStatus status = FlankStatus::absent;
  std::string reason;
  std::vector<double> along;  ///< the points in the window
  std::vector<double> height;
  LineFit least_squares;
  LineFit robust;
  LineFit shown;  ///< the one that gives the angle
  double angle_rad = 0;
  double fit_error_rad = 0;       ///< standard error from the grains' scatter
  double degrees_of_freedom = 1;  ///< independent stretches of the edge, less 2
  double window_spread_rad = 0;   ///< largest change when the window is moved
  double bend_rad = 0;            ///< upper half's angle minus lower half's
  double scatter = 0;             ///< robust standard deviation of the points around the line
  double grain = 0;               ///< grain size that was used
  std::vector<WindowAngle> other_windows;
  bool apron_cut = false;  ///< the window was shortened to leave an apron out
  bool frame_cut = false;  ///< the window was shortened because the frame ends
  bool vertical = false;   ///< absent because this side is an upright face
};

struct FlankOptions {
  double window_from = 0.2;  ///< of the crest's height
  double window_to = 0.8;
  bool leave_apron_out = true;
  std::optional<double> grain;  ///< [working px]; empty: read off the edge's bumps
  std::uint64_t seed = 1;
};

FlankFit fit_flank(const Profile& profile, Side side, const FlankOptions& options);

}  // namespace repose::vision
