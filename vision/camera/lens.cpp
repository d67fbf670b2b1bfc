#include "vision/camera/lens.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/camera/lens_correction.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

cv::Matx33d matrix_of(const Lens& lens) {
  const double f = lens.focal_px.value;
  return {f, 0, lens.centre_x_px.value - kPixelCentre,
          0, f, lens.centre_y_px.value - kPixelCentre,
          0, 0, 1};
}

cv::Vec<double, 5> distortion_of(const Lens& lens) {
  return {lens.k1.value, lens.k2.value, lens.p1.value, lens.p2.value, lens.k3.value};
}

/// Points along a box's outline, dense enough to follow its curved image.
std::vector<Point> around(const Box& box) {
  constexpr int kSteps = 8;
  std::vector<Point> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const double x = box.x + part * box.width;
    const double y = box.y + part * box.height;
    points.push_back({x, static_cast<double>(box.y)});
    points.push_back({x, static_cast<double>(box.y + box.height)});
    points.push_back({static_cast<double>(box.x), y});
    points.push_back({static_cast<double>(box.x + box.width), y});
  }
  return points;
}

template <typename Move>
Box moved(const Box& box, const Lens& lens, const Move& move) {
  double left = lens.width;
  double top = lens.height;
  double right = 0;
  double bottom = 0;
  for (const Point& corner : around(box)) {
    const Point here = move(corner);
    left = std::min(left, here.x);
    top = std::min(top, here.y);
    right = std::max(right, here.x);
    bottom = std::max(bottom, here.y);
  }
  const auto inside = [](double value, int most) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, most);
  };
  const int x = inside(left, lens.width - 1);
  const int y = inside(top, lens.height - 1);
  return {.x = x,
          .y = y,
          .width = std::max(1, inside(right, lens.width) - x),
          .height = std::max(1, inside(bottom, lens.height) - y)};
}

Box corrected_box(const Box& box, const Lens& lens) {
  return moved(box, lens, [&](Point point) { return lens.corrected(point); });
}

Point inside(Point point, const Lens& lens) {
  return {std::clamp(point.x, 0.0, static_cast<double>(lens.width)),
          std::clamp(point.y, 0.0, static_cast<double>(lens.height))};
}

}  // namespace

bool Lens::is_distorted() const {
  return k1.value != 0 || k2.value != 0 || p1.value != 0 || p2.value != 0 || k3.value != 0;
}

Point Lens::corrected(Point place) const {
  if (!is_distorted()) return place;
  const std::vector<cv::Point2d> from = {{place.x - kPixelCentre, place.y - kPixelCentre}};
  std::vector<cv::Point2d> to;
  // The default five iterations leave hundredths of a pixel in wide pictures.
  const cv::TermCriteria enough(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-10);
  cv::undistortPoints(from, to, matrix_of(*this), distortion_of(*this), cv::noArray(),
                      matrix_of(*this), enough);
  return {to.front().x + kPixelCentre, to.front().y + kPixelCentre};
}

Point Lens::seen(Point place) const {
  if (!is_distorted()) return place;
  const double x = (place.x - centre_x_px.value) / focal_px.value;
  const double y = (place.y - centre_y_px.value) / focal_px.value;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1.value + r2 * (k2.value + r2 * k3.value));
  const double across = x * radial + 2 * p1.value * x * y + p2.value * (r2 + 2 * x * x);
  const double down = y * radial + p1.value * (r2 + 2 * y * y) + 2 * p2.value * x * y;
  return {focal_px.value * across + centre_x_px.value, focal_px.value * down + centre_y_px.value};
}

Lens lens_for(const Lens& lens, int width, int height) {
  if (width == lens.width && height == lens.height) return lens;
  const double scale = static_cast<double>(width) / lens.width;
  // Sides are whole pixels.
  if (std::abs(height - scale * lens.height) > std::max(1.0, scale)) {
    throw base::InputError(
        {.value = fmt::format("the picture is {} x {} and the {} is for {} x {}", width, height,
                              base::field("camera file"), lens.width, lens.height),
         .rule = "the camera's whole picture, at any size",
         .fix = "use the picture as the camera took it, uncropped and not turned, or measure "
                "without the camera file."});
  }
  Lens scaled = lens;
  scaled.width = width;
  scaled.height = height;
  for (LensNumber* number : {&scaled.focal_px, &scaled.centre_x_px, &scaled.centre_y_px}) {
    number->value *= scale;
    number->uncertainty *= scale;
  }
  return scaled;
}

Lens turned(const Lens& lens, int clockwise_deg) {
  Lens upright = lens;
  for (int turn_deg = 0; turn_deg < clockwise_deg; turn_deg += 90) {
    const Lens before = upright;
    upright.width = before.height;
    upright.height = before.width;
    upright.centre_x_px = {before.height - before.centre_y_px.value,
                           before.centre_y_px.uncertainty};
    upright.centre_y_px = before.centre_x_px;
    // From Lens's two equations with (-y', x') for (x', y'); the radial part is rotationally
    // symmetric.
    upright.p1 = before.p2;
    upright.p2 = {-before.p1.value, before.p1.uncertainty};
  }
  return upright;
}

LensCorrection::LensCorrection(const Lens& lens) {
  if (!lens.is_distorted()) return;
  cv::initUndistortRectifyMap(matrix_of(lens), distortion_of(lens), cv::noArray(), matrix_of(lens),
                              {lens.width, lens.height}, CV_32FC1, to_x_, to_y_);
}

void LensCorrection::correct(const cv::Mat& picture, cv::Mat& corrected) const {
  if (to_x_.empty()) {
    picture.copyTo(corrected);
    return;
  }
  // Beyond what the camera saw, black could be mistaken for an object.
  cv::remap(picture, corrected, to_x_, to_y_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

Picture corrected_picture(const Picture& picture, const Lens& lens) {
  Picture corrected = blank_picture(picture.width, picture.height);
  cv::Mat target = mat_of(corrected);
  LensCorrection(lens).correct(mat_of(picture), target);
  return corrected;
}

MeasureOptions corrected_options(const MeasureOptions& options, const Lens& lens) {
  MeasureOptions corrected = options;
  for (Box& box : corrected.excluded) box = corrected_box(box, lens);
  Hints& hints = corrected.hints;
  if (hints.heap) hints.heap = corrected_box(*hints.heap, lens);
  const auto move = [&](Point& point) { point = inside(lens.corrected(point), lens); };
  if (hints.ground) {
    move(hints.ground->from);
    move(hints.ground->to);
  }
  for (Point& point : hints.keep) move(point);
  for (Point& point : hints.drop) move(point);
  if (!hints.mask.empty()) hints.mask = corrected_picture(hints.mask, lens);
  return corrected;
}

ScaleBar corrected_bar(const ScaleBar& bar, const Lens& lens) {
  return {.line = {lens.corrected(bar.line.from), lens.corrected(bar.line.to)},
          .length_mm = bar.length_mm};
}

Box seen_box(const Box& box, const Lens& lens) {
  return moved(box, lens, [&](Point point) { return lens.seen(point); });
}

}  // namespace repose::vision
