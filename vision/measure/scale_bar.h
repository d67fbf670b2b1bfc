#pragma once

#include "vision/picture/picture.h"

namespace repose::vision {

/// A value with the half-width of its 95 % interval.
struct Estimate {
  double value = 0;
  double uncertainty = 0;
};

/// Two points of the picture whose distance is known, in the plane that is measured: that in which
/// a grain moves, or that of a heap's middle.
struct ScaleBar {
  Segment line;
  double length_mm = 0;
};

/// What the interval of a scale comes from: two points that a person points at.
Estimate mm_per_px(const ScaleBar& scale);

}  // namespace repose::vision
