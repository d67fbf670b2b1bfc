#pragma once

#include <optional>

#include "base/input_error.h"
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

/// What a pixel can show: light resolves no less, and a heap of 100 pixels would be 100 m wide.
inline constexpr double kFinestScale_mm_per_px = 1e-4, kCoarsestScale_mm_per_px = 1e3;
/// Nearer to each other, two points cannot be pointed at.
inline constexpr double kShortestBar_px = 10;

/// What cannot be meant, whatever the picture.
std::optional<base::Fault> problem_of(const ScaleBar& scale);
/// What cannot be meant in a picture of this size. Proved by ScaleBar.* in
/// tests/vision/scale_bar_test.cpp.
std::optional<base::Fault> problem_in(const ScaleBar& scale, int width, int height);

/// What the interval of a scale comes from: two points that a person points at.
Estimate mm_per_px(const ScaleBar& scale);

}  // namespace repose::vision
