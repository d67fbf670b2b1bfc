#pragma once

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

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

}  // namespace repose::vision
