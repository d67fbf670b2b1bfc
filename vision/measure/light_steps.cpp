#include "vision/measure/light_steps.h"

#include <algorithm>
#include <cmath>

namespace repose::vision {

LightSteps light_steps(const cv::Mat1f& lightness, const cv::Mat1b& inside) {
  constexpr float kNone = 0.05F;
  double sum = 0;
  int even = 0;
  int pairs = 0;
  for (int row = 0; row < inside.rows; row += 2) {
    for (int col = 0; col + 1 < inside.cols; col += 2) {
      if (inside(row, col) == 0 || inside(row, col + 1) == 0) continue;
      const float step = std::abs(lightness(row, col + 1) - lightness(row, col));
      sum += step;
      even += step < kNone ? 1 : 0;
      ++pairs;
    }
  }
  return {.mean = sum / std::max(1, pairs), .even = static_cast<double>(even) / std::max(1, pairs)};
}

}  // namespace repose::vision
