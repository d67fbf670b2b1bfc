#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_facts.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// Films: what all experiments that are tracked have in common.
namespace repose::vision {

/// A value with the half-width of its 95 % interval.
struct Estimate {
  double value = 0;
  double uncertainty = 0;
};

/// Two points of the picture whose distance is known, in the plane in which the grain moves.
struct ScaleBar {
  Segment line;
  double length_mm = 0;
};

struct TrackOptions {
  std::optional<ScaleBar> scale = {};
  /// Of a roll without a scale: how far up the incline the grain was let go.
  std::optional<double> released_mm = {};
  bool draws_strobe = false;
  /// Told which fraction of the work is done, from 0 to 1; may throw to stop it.
  std::function<void(double)> progress = {};
};

/// The centre of the grain in one frame.
struct GrainPlace {
  double time_s = 0;
  Point centre;
};

/// What the interval of a scale comes from: two points that a person points at.
Estimate mm_per_px(const ScaleBar& scale);

}  // namespace repose::vision
