#pragma once

#include <algorithm>
#include <cmath>

#include "vision/measure/repose_angle.h"

/// Results of measuring triangles, computed instead of measured: their numbers are exact.
namespace repose::vision {

inline constexpr double kExact = 1e-9;  ///< rounding error allowed in those numbers

/// A heap with straight sides, in a picture [px].
struct TriangleHeap {
  double left_base = 300;   ///< from the left foot to the point below the tip
  double right_base = 300;  ///< likewise
  double height = 150;
  double tip_x = 500;
  double ground_y = 600;
  double tilt_rad = 0;    ///< of the ground about (tip_x, ground_y), > 0: right end lower
  double step = 1;        ///< between points of the edge
  double cut_left = 0;    ///< length of the left side beyond the picture's edge
  bool has_left = true;   ///< otherwise it stands against a wall below its tip
  bool has_right = true;  ///< likewise
  double uncertainty_rad = 0.004;
};

inline ReposeAngle measured(const TriangleHeap& heap) {
  const auto in_picture = [&](double along, double height) {
    const double cos = std::cos(heap.tilt_rad), sin = std::sin(heap.tilt_rad);
    return Point{heap.tip_x + along * cos + height * sin,
                 heap.ground_y + along * sin - height * cos};
  };
  const double from = heap.has_left ? -heap.left_base + heap.cut_left : 0;
  const double to = heap.has_right ? heap.right_base : 0;
  const auto height_at = [&](double along) {
    const double base = along < 0 ? heap.left_base : heap.right_base;
    return heap.height * (1 - std::abs(along) / base);
  };
  ReposeAngle result;
  result.status = MeasureStatus::ok;
  for (double along = from; along < to; along += heap.step) {
    result.upper_edge.push_back(in_picture(along, height_at(along)));
    const bool passes_tip = along < 0 && along + heap.step > 0;
    if (passes_tip) result.upper_edge.push_back(in_picture(0, heap.height));
  }
  result.upper_edge.push_back(in_picture(to, height_at(to)));
  result.ground = Segment{in_picture(from, 0), in_picture(to, 0)};
  result.crest = in_picture(0, heap.height);
  result.height_px = heap.height;
  result.base_px = to - from;

  const auto flank = [&](bool exists, double base) {
    Flank one;
    one.status = exists ? FlankStatus::ok : FlankStatus::absent;
    if (exists) one.angle_rad = std::atan(heap.height / base);
    if (exists) one.uncertainty_rad = heap.uncertainty_rad;
    return one;
  };
  result.left = flank(heap.has_left && heap.cut_left == 0, heap.left_base);
  result.right = flank(heap.has_right, heap.right_base);
  if (heap.cut_left > 0) {
    result.left.status = FlankStatus::truncated;
    result.left.leaves_frame = true;
  }
  const double left = result.left.angle_rad.value_or(0), right = result.right.angle_rad.value_or(0);
  const bool both = result.left.angle_rad && result.right.angle_rad;
  result.angle_rad = both ? (left + right) / 2 : left + right;
  result.uncertainty_rad = heap.uncertainty_rad;
  return result;
}

}  // namespace repose::vision
