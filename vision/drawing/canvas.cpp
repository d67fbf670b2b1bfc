#include "vision/drawing/canvas.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr int kFractionBits = 4;  // OpenCV draws at sixteenths of a pixel

/// The pieces of a path that a pen leaves which is down for `dash` and up for as long.
std::vector<Path> dashes_of(const Path& path, double dash) {
  std::vector<Path> dashes;
  double left = 0;  // of the dash or gap
  bool is_down = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const cv::Point2d from = path[i - 1], to = path[i];
    const double whole = cv::norm(to - from);
    double at = 0;
    while (at < whole) {
      const cv::Point2d here = from + (to - from) * (at / whole);
      if (left <= 0) {
        is_down = !is_down;
        left = dash;
        if (is_down) dashes.push_back({here});
      }
      const double step = std::min(left, whole - at);
      at += step;
      left -= step;
      if (is_down) dashes.back().push_back(from + (to - from) * (at / whole));
    }
  }
  return dashes;
}

}  // namespace

Canvas::Canvas(cv::Mat& image, double scale, const cv::Scalar& halo)
    : image_(image),
      scale_(scale),
      size_(std::sqrt(static_cast<double>(image.cols) * image.rows)),
      halo_(halo) {}

int Canvas::stroke(double weight) const { return std::max(1, cvRound(weight * size_ / 350)); }

Path Canvas::path_of(const std::vector<Point>& points) const {
  Path path;
  path.reserve(points.size());
  for (const Point& point : points) path.push_back(at(point));
  return path;
}

void Canvas::draw(const Path& path, const cv::Scalar& colour, double weight, bool closed) const {
  const int halo = stroke(weight) + 2 * std::max(1, stroke(weight) / 3);
  draw_once(path, halo_, halo, closed);
  draw_once(path, colour, stroke(weight), closed);
}

void Canvas::draw_dashed(const Path& path, const cv::Scalar& colour, double weight,
                         double dash) const {
  for (const Path& piece : dashes_of(path, length(dash))) draw(piece, colour, weight);
}

void Canvas::draw_once(const Path& path, const cv::Scalar& colour, int thickness,
                       bool closed) const {
  std::vector<cv::Point> points;
  points.reserve(path.size());
  for (const cv::Point2d& point : path) {
    // OpenCV counts from the centre of the first pixel, we from its corner.
    points.emplace_back(cvRound((point.x - 0.5) * (1 << kFractionBits)),
                        cvRound((point.y - 0.5) * (1 << kFractionBits)));
  }
  cv::polylines(image_, points, closed, colour, thickness, cv::LINE_AA, kFractionBits);
}

}  // namespace repose::vision
