#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/descent.h"
#include "vision/measure/line_fit.h"
#include "vision/measure/profile.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

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
  double window_from = 0;         ///< of the crest's height: the stretch that was fitted
  double window_to = 0;
  std::vector<WindowAngle> other_windows;
  bool apron_cut = false;            ///< the window was shortened to leave an apron out
  std::optional<double> high_apron;  ///< one begins at this part of the height: too high to cut off
  bool frame_cut = false;            ///< the window was shortened because the frame ends
  bool vertical = false;             ///< absent because this side is an upright face
};

struct FlankOptions {
  double window_from = 0.2;  ///< of the crest's height
  double window_to = 0.8;
  bool leave_apron_out = true;
  std::optional<double> grain;  ///< [working px]; empty: read off the edge's bumps
  std::uint64_t seed = 1;
};

/// Fits lines to the stretch of a side on which the edge has the window's heights. The stretch ends
/// higher where the frame cuts off up to a fifth of the window, and where an apron begins below a
/// third of the heap's height.
FlankFit fit_flank(const Profile& profile, Side side, const FlankOptions& options);

}  // namespace repose::vision
