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

/// Two points of the picture a known distance apart, in the plane that is measured: the plane of a
/// grain's motion, or that through the middle of a heap.
struct ScaleBar {
  Segment line;
  double length_mm = 0;
};

/// Limits of a picture's scale: light resolves nothing finer, and a heap of 100 pixels would be 100
/// m wide.
inline constexpr double kFinestScale_mm_per_px = 1e-4, kCoarsestScale_mm_per_px = 1e3;
/// Points closer together than this cannot be marked accurately.
inline constexpr double kShortestBar_px = 10;

/// An error that holds for any picture.
std::optional<base::Fault> problem_of(const ScaleBar& scale);
/// An error for a picture of this size. Proved by ScaleBar.* in tests/vision/scale_bar_test.cpp.
std::optional<base::Fault> problem_in(const ScaleBar& scale, int width, int height);

/// The scale; its interval comes from marking both points by hand.
Estimate mm_per_px(const ScaleBar& scale);

}  // namespace repose::vision
