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

/// Colours (L*a*b*) of the pixels along one side of an edge.
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

/// The step between two bands over their scatter; inside, the pattern of grains adds scatter
/// anyway.
inline double step_contrast(const Band& outside, const Band& inside) {
  return cv::norm(inside.mean() - outside.mean()) /
         std::sqrt(4 + outside.variance() + 0.5 * inside.variance());
}

/// Maps 0 to infinity onto 0 to 1; `half` gives 0.5.
inline double saturated(double value, double half) { return value / (value + half); }

/// A near-level line through as many points as possible, with hardly any of the heap below it.
struct SupportLine {
  PictureLine line;
  double fraction = 0;       ///< fraction of the points that lie on the line
  double deviation_rad = 0;  ///< standard uncertainty of its tilt
};

/// Steepest ground line considered plausible. A level tripod stays below 3 degrees.
inline constexpr double kMaxGroundTilt_rad = 8 * kDegree;

/// The line with most points within `tolerance` and next to none below it (y larger). Exhaustive
/// over pairs of a fixed subset, so not random. std::nullopt for fewer than 8 points, or if no such
/// line is near level.
std::optional<SupportLine> support_line(const std::vector<Point>& points, double tolerance);

/// First and last column of the heap's base.
struct Base {
  double from = 0;
  double to = 0;
};

/// How clearly the picture itself shows an edge along a line under a base and a little beyond, 0 to
/// 1: the step from the rows just above it to those just below, over their scatter.
double ground_evidence(const PictureLine& ground, const Base& base, const WorkingPicture& work);

/// The line a heap stands on, and how it was found.
struct Ground : PictureLine {
  double deviation_rad = 0;        ///< standard uncertainty of its tilt
  std::optional<double> bow = {};  ///< how far the base bows downwards, as a fraction of its width;
                                   ///< std::nullopt if the base is not seen
  bool mirrored = false;           ///< it is the axis of a reflection
  bool behind = false;             ///< the heap extends below it: an edge behind the heap
  bool before = false;             ///< the heap ends above it: an edge in front of the heap
};

/// Bow of a base that is seen from its own level.
inline constexpr double kFlatBase = 0.006;

/// Finds the ground below one region: bare ground beside the heap if the region includes the
/// ground; otherwise the region's own base, the axis of a reflection, or the line through the two
/// ends of a base that bows. std::nullopt if none of these is near level.
std::optional<Ground> find_ground(const Spans& region, const WorkingPicture& work);

/// Of all ground lines that segmentations found along the base, the one that the picture itself
/// shows best: a segmentation that sees the flanks sharply may still bleed into the plate. If that
/// is an edge behind the heap, the best of those at its foot is taken instead. If none of them lies
/// on a clear edge, the edge is searched for nearby. The scatter between equally good lines, and
/// half of the change made by the search, are added to the tilt's uncertainty. Needs at least one
/// candidate.
Ground best_ground(const std::vector<Ground>& candidates, const Base& base,
                   const WorkingPicture& work);

}  // namespace repose::vision
