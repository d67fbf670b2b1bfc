#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "base/units.h"
#include "vision/measure/geometry.h"
#include "vision/measure/regions.h"
#include "vision/measure/working_picture.h"

/// The step in colour from one side of an edge to the other.

namespace repose::vision {

/// Colours (L*a*b*) of the pixels beside a stretch of an edge.
struct Band {
  cv::Vec3d sum;
  double squares = 0;
  int count = 0;

  void add(const cv::Vec3f& colour) {
    const cv::Vec3d value = colour;
    sum += value;
    squares += value.dot(value);
    ++count;
  }
  cv::Vec3d mean() const { return sum / std::max(1, count); }
  double variance() const {
    const cv::Vec3d m = mean();
    return std::max(0.0, squares / std::max(1, count) - m.dot(m));
  }
};

/// The step between two bands over their scatter; the inside is a pattern of grains anyway.
inline double step_contrast(const Band& outside, const Band& inside) {
  return cv::norm(inside.mean() - outside.mean()) /
         std::sqrt(4 + outside.variance() + 0.5 * inside.variance());
}

/// Maps 0 to infinity onto 0 to 1; `half` gives 0.5.
inline double saturated(double value, double half) { return value / (value + half); }

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

/// The line a heap stands on, and what gave it away.
struct Ground : PictureLine {
  double deviation_rad = 0;        ///< standard uncertainty of its tilt
  std::optional<double> bow = {};  ///< how far the base bows downwards, as a fraction of its width;
                                   ///< empty when the base is not seen
  bool mirrored = false;           ///< it is the axis of a reflection
  bool behind = false;             ///< the heap goes on below it: an edge behind the heap
  bool before = false;             ///< the heap ends above it: an edge before the heap
};

/// Bow of a base that is seen from its own level.
inline constexpr double kFlatBase = 0.006;

/// Finds the ground below one region: bare ground beside the heap when the region holds the ground,
/// too; else the region's own base; else the axis of a reflection; else the line through the two
/// ends of a base that bows. Empty when none of these is near level.
std::optional<Ground> find_ground(const Spans& region, const WorkingPicture& work);

/// The ground that the picture itself shows best along the base, of all that segmentations have
/// found there: one that sees the flanks sharply may still bleed into the plate. Where that is an
/// edge behind the heap it is the best of those that are its foot. Where none of them
/// lies on a plain edge, the edge is searched for nearby. What equally good lines disagree about,
/// and half of what the search changes, is added to the tilt's uncertainty. Needs a candidate.
Ground best_ground(const std::vector<Ground>& candidates, const Base& base,
                   const WorkingPicture& work);

}  // namespace repose::vision
