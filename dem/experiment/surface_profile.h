#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

struct SurfaceOptions {
  int views = 18;           ///< directions, evenly over half a turn; the first looks along y
  double window_from = .2;  ///< of the crest's height
  double window_to = .8;
};

/// A heap's surface, seen from the side from several directions.
struct SurfaceReading {
  double angle_deg = 0;          ///< mean of all views; 0 without a flank
  double between_views_deg = 0;  ///< standard deviation
  double first_view_deg = 0;     ///< of the first view alone
  double height_m = 0;           ///< of the highest point
  double base_radius_m = 0;      ///< from the crest to where the fitted lines meet the ground, at
                                 ///< most twice as far as the outline reaches; mean
  int flanks = 0;                ///< how many there were to fit, two a view
};

/// The angle of a heap of spheres on the ground z = 0, as a picture from the side gives it.
///
/// Each view's silhouette is the upper envelope of all spheres, in columns a twentieth of a mean
/// sphere's radius wide. The heap is what hangs together with the highest column; grains beyond a
/// gap are not part of it. A view's angle is the mean of both sides' slopes (flank_line.h), each
/// fitted in the window as to a rendered silhouette; the crest is that of the smoothed envelope.
/// Over 95 views of 12 heaps of hazelnuts it is as a silhouette of the same view is measured: 91
/// within .25 degrees, the median .01 off, the worst 13. A layer, which falls only at its
/// outermost grains, has no flank. Proved by SurfaceProfile.* in
/// tests/dem/experiment_surface_test.cpp.
///
/// Throws std::invalid_argument for no spheres, for none above the ground, and for a window or a
/// number of views that makes no sense.
SurfaceReading measure_surface(const std::vector<ClumpSphere>& spheres,
                               const SurfaceOptions& options = {});

}  // namespace repose::dem
