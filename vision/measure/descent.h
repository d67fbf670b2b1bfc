#pragma once

#include <vector>

#include "vision/measure/line_fit.h"
#include "vision/measure/profile.h"

namespace repose::vision {

enum class Side { left, right };

/// A line that falls less than this is level: where it has a height says nothing.
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
LineFit line_through(const Descent& descent, const Stretch& stretch);

/// Columns in which the lightly smoothed edge has come below the height `high` and not yet below
/// `low`.
Stretch rough_stretch(const Descent& descent, double low, double high);

/// The same between the places where the smoothed edge has these heights. Smoothed is the edge by
/// the straight line through it over three grains, of which one bump more or less changes little:
/// ends that follow single bumps would take in those above the line at the foot and leave out those
/// below it, and flatten the line (by .4 degrees on heaps five grains high).
/// Proved by FitFlank.HollowFlanksAreFittedWhereTheEdgeHasTheHeights and
/// FitFlank.BumpsDoNotTurnTheLine.
Stretch smoothed_stretch(const Descent& descent, double low, double high, double grain);

}  // namespace repose::vision
