#pragma once

#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "vision/compare/heap_comparison.h"
#include "vision/drawing/canvas.h"

/// How the two heaps of a comparison are told apart, in chart and legend: by the line's kind first,
/// so that a black-and-white print will do. And the words that its figures share.
namespace repose::vision {

inline const cv::Scalar kInk{30, 30, 30};
inline const cv::Scalar kFaint{110, 110, 110};

/// The first heap's line is solid and dark, the second one's dashed and lighter.
void draw_heap_line(const Canvas& canvas, const Path& path, std::size_t heap);

/// A bar of a round length in the image's upper left corner.
void draw_scale_bar(const Canvas& canvas, double px_per_m, const Lettering& lettering);

/// "4.1 mm", or a part of what both heaps were made equal in.
std::string length_text(double length, LengthUnit unit);

/// The difference of two angles with its interval and verdict, or that there is none.
std::string difference_text(const std::optional<AngleDifference>& angle, double margin_rad);

}  // namespace repose::vision
