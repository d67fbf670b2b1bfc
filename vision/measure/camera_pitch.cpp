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

double angle_without_pitch(double apparent_rad, double pitch_rad, double apex_pitch_rad) {
  const double down = std::tan(apex_pitch_rad);
  const double across = std::cos(pitch_rad) + std::sin(pitch_rad) * down;
  return std::atan(std::hypot(std::tan(apparent_rad) * across, down));
}

double angle_without_aside(double apparent_rad, double aside_rad) {
  return std::atan(std::tan(apparent_rad) / std::cos(aside_rad));
}

double far_camera_error(double apparent_rad, double pitch_rad, double apex_rise) {
  const double near_rad = pitch_rad - std::atan(apex_rise / kNearestCamera);
  return std::abs(angle_without_pitch(apparent_rad, pitch_rad) -
                  angle_without_pitch(apparent_rad, pitch_rad, near_rad));
}

double pitch_from_bow(double bow) {
  constexpr double kParabolaOfEllipse = 15 * std::numbers::pi / 64;
  return std::asin(std::clamp(2 * bow / kParabolaOfEllipse, 0.0, 1.0));
}

double assumed_pitch_error(double apparent_rad, double pitch_rad) {
  return angle_without_pitch(apparent_rad, pitch_rad) - apparent_rad;
}

}  // namespace repose::vision
