#pragma once

#include <cmath>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Straight line in a picture, y as a function of x; y points down.
struct PictureLine {
  double y_at_0 = 0;
  double slope = 0;

  double y(double x) const { return y_at_0 + slope * x; }
  double tilt_rad() const { return std::atan(slope); }
};

/// Coordinates along a ground line and above it, in the picture's pixels.
class GroundFrame {
 public:
  explicit GroundFrame(const PictureLine& ground)
      : origin_{0, ground.y_at_0},
        cos_(std::cos(ground.tilt_rad())),
        sin_(std::sin(ground.tilt_rad())) {}

  double along(Point p) const { return (p.x - origin_.x) * cos_ + (p.y - origin_.y) * sin_; }
  double height(Point p) const { return (p.x - origin_.x) * sin_ - (p.y - origin_.y) * cos_; }
  Point picture(double along, double height) const {
    return {origin_.x + along * cos_ + height * sin_, origin_.y + along * sin_ - height * cos_};
  }

 private:
  Point origin_;
  double cos_;
  double sin_;
};

}  // namespace repose::vision
