#pragma once

#include <optional>
#include <vector>

#include "base/units.h"
#include "vision/measure/geometry.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// A near-level line through as many points as possible, none of them the heap's.
struct SupportLine {
  PictureLine line;
  double fraction = 0;       ///< of the points that lie on the line
  double deviation_rad = 0;  ///< standard uncertainty of its tilt
};

/// Steepest ground line that is believed. A level tripod stays below 3 degrees.
inline constexpr double kMaxGroundTilt_rad = 8 * kDegree;

/// The line on which most points lie within `tolerance` with next to none below it (y larger).
/// Exhaustive over pairs of a fixed subset: no chance involved. Empty for fewer than 8 points.
std::optional<SupportLine> support_line(const std::vector<Point>& points, double tolerance);

/// First and last column that a heap stands on.
struct Base {
  double from = 0;
  double to = 0;
};

/// How far the picture itself shows an edge along a line under a base and a little beyond, 0 to 1:
/// the step from the rows just above it to those just below, over their scatter.
double ground_evidence(const PictureLine& ground, const Base& base, const WorkingPicture& work);

}  // namespace repose::vision
