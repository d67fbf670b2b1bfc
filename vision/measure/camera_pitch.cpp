#include "vision/measure/camera_pitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace repose::vision {

double angle_without_pitch(double apparent_rad, double pitch_rad) {
  if (pitch_rad == 0) return apparent_rad;
  const double t = std::tan(apparent_rad);
  const double s = std::sin(pitch_rad);
  return std::atan(std::sqrt(t * t + s * s) / std::cos(pitch_rad));
}

double pitch_from_bow(double bow) {
  constexpr double kParabolaOfEllipse = 15 * std::numbers::pi / 64;
  return std::asin(std::clamp(2 * bow / kParabolaOfEllipse, 0.0, 1.0));
}

}  // namespace repose::vision
