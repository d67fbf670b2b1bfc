#pragma once

#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "vision/compare/heap_comparison.h"
#include "vision/drawing/canvas.h"

/// How chart and legend distinguish the two heaps of a comparison: primarily by line style, so that
/// black-and-white prints work. Also text that the figures share.
namespace repose::vision {

inline const cv::Scalar kInk{30, 30, 30};
inline const cv::Scalar kFaint{110, 110, 110};

/// The first heap's line is solid and dark, the second one's dashed and lighter.
void draw_heap_line(const Canvas& canvas, const Path& path, std::size_t heap);

/// A bar of a round length in the image's upper left corner.
void draw_scale_bar(const Canvas& canvas, double px_per_m, const Lettering& lettering);

/// "4.1 mm", or a fraction of the quantity in which both heaps were made equal.
std::string length_text(double length, LengthUnit unit);

/// The difference of two angles with its interval and verdict, or a note that there is none.
std::string difference_text(const std::optional<AngleDifference>& angle, double margin_rad);

}  // namespace repose::vision
