#include "vision/track/parabola.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

namespace repose::vision {

Parabola parabola_through(const std::vector<SeenAt>& path, std::size_t from, std::size_t count) {
  const SeenAt& middle = path[from + count / 2];
  const double length_s = path[from + count - 1].time_s - path[from].time_s;
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  double squares = 0;
  for (std::size_t k = from; k < from + count; ++k) {
    const double t = (path[k].time_s - middle.time_s) / length_s;
    const double y = path[k].y_px - middle.y_px;
    const cv::Vec3d terms(1, t, .5 * t * t);
    normal += terms * terms.t();
    right += y * terms;
    squares += y * y;
  }
  const cv::Matx33d inverse = normal.inv();
  const cv::Vec3d solution = inverse * right;
  constexpr double kLeastRms_px = .1;
  const double left = std::max(0.0, squares - solution.dot(right));
  const double rms = std::sqrt(left / static_cast<double>(count - 3));
  const double per_s2 = 1 / (length_s * length_s);
  return {.acceleration = per_s2 * solution[2],
          .rms_px = rms,
          .error = per_s2 * std::max(rms, kLeastRms_px) * std::sqrt(inverse(2, 2))};
}

}  // namespace repose::vision
