#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/drawing/overlay_style.h"
#include "vision/picture/picture.h"

namespace repose::vision {

using Path = std::vector<cv::Point2d>;

/// An image that shows a picture enlarged `scale` times, with the sizes of strokes and letters that
/// suit it. Lines have a halo, so that they show on any ground.
class Canvas {
 public:
  Canvas(cv::Mat& image, double scale, const cv::Scalar& halo = kDark);

  /// Point of the picture that lies in the image's top left corner; (0, 0) before.
  void set_corner(const Point& corner) { corner_ = corner; }

  cv::Mat& image() const { return image_; }
  cv::Point2d at(const Point& point) const {
    return {(point.x - corner_.x) * scale_, (point.y - corner_.y) * scale_};
  }
  int stroke(double weight) const;
  double length(double part) const { return part * size_; }
  Path path_of(const std::vector<Point>& points) const;

  void draw(const Path& path, const cv::Scalar& colour, double weight, bool closed = false) const;
  /// Dashes and gaps are `dash` long, which is a part of the image's size.
  void draw_dashed(const Path& path, const cv::Scalar& colour, double weight,
                   double dash = 0.012) const;

 private:
  void draw_once(const Path& path, const cv::Scalar& colour, int thickness, bool closed) const;

  cv::Mat& image_;
  double scale_;
  double size_;
  cv::Scalar halo_;
  Point corner_;
};

}  // namespace repose::vision
