#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/line_fit.h"
#include "vision/measure/profile.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// A line that falls less than this is level: where it crosses a given height means nothing.
inline constexpr double kFlattestSlope = 0.02;

/// The points of one side of a heap from the crest outwards [working px].
struct Descent {
  std::vector<double> u;       ///< distance from the crest along the ground, ascending
  std::vector<double> h;       ///< height above the ground
  std::vector<double> smooth;  ///< height, lightly smoothed
};

Descent descent_of(const Profile& profile, Side side);

/// Some columns of a descent.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;  ///< one past the end
  std::size_t size() const { return last > first ? last - first : 0; }
};

/// First column at or beyond the distance `u` from the crest.
std::size_t column_at(const Descent& descent, double u);

/// The least-squares line through the points of a stretch.
/// @param weight  of all columns of the descent; empty: equal weights
LineFit line_through(const Descent& descent, const Stretch& stretch,
                     const std::vector<double>& weight = {});

/// Columns from where the lightly smoothed edge drops below the height `high` to where it drops
/// below `low`.
Stretch rough_stretch(const Descent& descent, double low, double high);

/// The same, but between the places where an edge smoothed by a straight line through three grains
/// has these heights. One bump more or less hardly changes that; ends that follow single bumps
/// would take in those above the line at the foot and leave out those below it, and flatten the
/// line (by .4 degrees on heaps five grains high). Proved by
/// FitFlank.HollowFlanksAreFittedWhereTheEdgeHasTheHeights and FitFlank.BumpsDoNotTurnTheLine.
Stretch smoothed_stretch(const Descent& descent, double low, double high, double grain);

/// A foot with less than half weight.
struct Apron {
  double from = 0;            ///< of the crest's height: columns below have less than half weight
  double length = 0;          ///< from there to the foot
  bool is_high = false;       ///< begins above a third of the height, and is not a thin layer
  double angle_with_rad = 0;  ///< angle of the line if the apron had full weight
  LineFit line_with = {};     ///< that line
};

/// One side of the heap, fitted. Lengths in working pixels, along and above the ground line.
struct FlankFit {
  FlankStatus status = FlankStatus::absent;
  std::string reason;
  std::vector<double> along;  ///< the points in the window
  std::vector<double> height;
  std::vector<double> weight;  ///< weight of each point; empty: equal weights
  LineFit least_squares;
  LineFit robust;
  LineFit shown;  ///< the one that gives the angle
  double angle_rad = 0;
  double fit_error_rad = 0;       ///< standard error from the grains' scatter
  double degrees_of_freedom = 1;  ///< independent stretches of the edge, minus 2
  double window_spread_rad = 0;   ///< largest change when the window is moved
  double bend_rad = 0;            ///< upper half's angle minus lower half's
  double apron_rad = 0;           ///< change of the angle if an apron had full weight
  double scatter = 0;             ///< robust standard deviation of the points around the line
  double grain = 0;               ///< grain size that was used
  double window_from = 0;         ///< of the crest's height: the stretch with at least half weight
  double window_to = 0;
  std::vector<WindowAngle> other_windows;
  std::optional<Apron> apron;
  bool frame_cut = false;  ///< the window was shortened because the frame ends
  bool vertical = false;   ///< absent because this side is an upright face

  /// Number of points with at least half weight, which are the first ones from the crest.
  std::size_t counted() const;
  /// How far the flank bends beyond what the grains' scatter explains; 0 or above.
  double sure_bend_rad() const;
};

/// Mean of the sides that exist; 0 if none.
double mean_angle_rad(const FlankFit& left, const FlankFit& right);

struct FlankOptions {
  double window_from = 0.2;  ///< of the crest's height
  double window_to = 0.8;
  bool leave_apron_out = true;
  bool is_robust = true;        ///< false: ordinary least squares give the angle
  std::optional<double> grain;  ///< [working px]; std::nullopt: estimated from the edge's bumps
  std::uint64_t seed = 1;
};

/// Fits lines to the stretch of a side where the edge has the window's heights. It ends higher if
/// the frame cuts off up to a fifth of the window.
///
/// An apron, a foot much flatter than the flank above it, has little weight: where the slope over
/// three grains to either side is below .4 of the slope of the window's upper half, a column's
/// weight is (slope / that .4)^6, and never more than that of a column nearer to the crest. So the
/// line follows each change of the foot's shape without a jump. With equal weights, a level apron
/// that came to lie just above the window's lower end would turn the line by ten degrees and more.
/// The power is well above 3: for a given height, an apron is longer the flatter it is, and its
/// leverage on a line's slope grows with the third power of its length. The convention is our own.
/// Proved by ApronSteps.* and Apron.* in tests/vision/apron_test.cpp.
FlankFit fit_flank(const Profile& profile, Side side, const FlankOptions& options);

}  // namespace repose::vision
