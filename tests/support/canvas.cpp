#include "tests/support/canvas.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::testing {
namespace {

constexpr int kFineBits = 4;  // of a coordinate's fraction of a pixel

/// Light that falls on (u, v), each from -1 to 1 over the shape's bounding box.
double light_at(const Paint& paint, double u, double v) {
  constexpr double kRight = -.40, kUp = .62, kNear = .675;  // where the lamp is
  if (paint.shading == Shading::slope) {
    return 1 + .5 * paint.contrast *
                   (u * std::cos(paint.towards_rad) - v * std::sin(paint.towards_rad));
  }
  const double up = paint.shading == Shading::ball ? -v : 0;
  const double near = std::sqrt(std::max(0.0, 1 - u * u - up * up));
  const double lit = std::max(0.0, u * kRight + up * kUp + near * kNear);
  return 1 - paint.contrast + 2 * paint.contrast * lit;
}

}  // namespace

Canvas::Canvas(const HeapScene& scene, Random& random)
    : width_px_(scene.width),
      height_(static_cast<double>(scene.height) / scene.width),
      random_(random.seed()) {
  stage_ = empty_stage(scene);
  stage_.light = cv::Mat(stage_.size, CV_32FC3, cv::Scalar::all(.5));
}

cv::Point Canvas::fine(Place place, cv::Point corner) const {
  const auto fixed = [](double px) {
    return static_cast<int>(std::lround(std::clamp(px, -2e4, 2e4) * (1 << kFineBits)));
  };
  return {fixed(stage_.margin_px + place.x * width_px_ - corner.x),
          fixed(stage_.margin_px + place.y * width_px_ - corner.y)};
}

cv::Rect Canvas::box_of(const Places& places, double more) const {
  cv::Rect2d box(places.front(), cv::Size2d(0, 0));
  for (const Place& p : places) {
    const double right = std::max(box.x + box.width, p.x);
    const double bottom = std::max(box.y + box.height, p.y);
    box.x = std::min(box.x, p.x);
    box.y = std::min(box.y, p.y);
    box.width = right - box.x;
    box.height = bottom - box.y;
  }
  const double margin = stage_.margin_px;
  const cv::Point from(static_cast<int>((box.x - more) * width_px_ + margin) - 2,
                       static_cast<int>((box.y - more) * width_px_ + margin) - 2);
  const cv::Point to(static_cast<int>((box.x + box.width + more) * width_px_ + margin) + 3,
                     static_cast<int>((box.y + box.height + more) * width_px_ + margin) + 3);
  return cv::Rect(from, to) & cv::Rect({0, 0}, stage_.size);
}

void Canvas::blend(const cv::Mat& mask, cv::Rect box, const Paint& paint) {
  const cv::Vec3f color = light_of(paint.color);
  const cv::Mat field =
      pattern_field(paint.pattern, box.size(), paint.pattern_scale * width_px_, random_);
  const double half_width = std::max(1.0, box.width / 2.0);
  const double half_height = std::max(1.0, box.height / 2.0);
  for (int row = 0; row < box.height; ++row) {
    for (int column = 0; column < box.width; ++column) {
      const int covered = mask.at<uchar>(row, column);
      if (covered == 0) continue;
      const double light =
          light_at(paint, (column - half_width) / half_width, (row - half_height) / half_height) *
          std::max(.1, 1 + paint.pattern_strength * field.at<float>(row, column));
      const auto part = static_cast<float>(paint.opacity * covered / 255);
      auto& pixel = stage_.light.at<cv::Vec3f>(box.y + row, box.x + column);
      pixel = pixel * (1 - part) + color * static_cast<float>(std::max(0.0, light)) * part;
    }
  }
}

void Canvas::fill(const Places& polygon, const Paint& paint) {
  const cv::Rect box = box_of(polygon, 0);
  if (box.empty()) return;
  cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
  std::vector<cv::Point> corners;
  for (const Place& p : polygon) corners.push_back(fine(p, box.tl()));
  cv::fillPoly(mask, std::vector{corners}, 255, cv::LINE_AA, kFineBits);
  blend(mask, box, paint);
}

void Canvas::stroke(const Places& line, double width, const Paint& paint) {
  const cv::Rect box = box_of(line, width);
  if (box.empty()) return;
  cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
  std::vector<cv::Point> points;
  for (const Place& p : line) points.push_back(fine(p, box.tl()));
  const int thick = std::clamp(static_cast<int>(std::lround(width * width_px_)), 1, 300);
  cv::polylines(mask, points, false, 255, thick, cv::LINE_AA, kFineBits);
  blend(mask, box, paint);
}

void Canvas::write(const std::string& text, Place at, double size, int font, const Paint& paint) {
  constexpr double kHeightAtOne = 22;  // of capital letters [px]
  const double scale = size * width_px_ / kHeightAtOne;
  const int thick = std::max(1, static_cast<int>(scale * random_.uniform(1.5, 5)));
  cv::Mat mask = cv::Mat::zeros(stage_.size, CV_8U);
  const cv::Point corner = fine(at, {0, 0}) / (1 << kFineBits);
  cv::putText(mask, text, corner, font, scale, 255, thick, cv::LINE_AA);
  blend(mask, {{0, 0}, stage_.size}, paint);
}

void Canvas::darken(const Places& polygon, double strength, double softness) {
  const cv::Rect box = box_of(polygon, 3 * softness);
  if (box.empty()) return;
  cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
  std::vector<cv::Point> corners;
  for (const Place& p : polygon) corners.push_back(fine(p, box.tl()));
  cv::fillPoly(mask, std::vector{corners}, 255, cv::LINE_AA, kFineBits);
  const double sigma = std::max(.5, softness * width_px_);
  cv::GaussianBlur(mask, mask, {}, sigma, sigma, cv::BORDER_REPLICATE);
  blend(mask, box, {.color = {}, .opacity = strength});
}

Places rectangle(Place from, Place to) { return {from, {to.x, from.y}, to, {from.x, to.y}}; }

Places ellipse(Place middle, double half_width, double half_height, double turn_rad) {
  constexpr int kCorners = 96;
  Places places;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * CV_PI * i / kCorners;
    places.push_back(
        {middle.x + half_width * std::cos(angle), middle.y + half_height * std::sin(angle)});
  }
  return turned(places, middle, turn_rad);
}

Places rounded(Places polygon, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    Places finer;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place& here = polygon[i];
      const Place& next = polygon[(i + 1) % polygon.size()];
      finer.push_back(here * .75 + next * .25);
      finer.push_back(here * .25 + next * .75);
    }
    polygon = std::move(finer);
  }
  return polygon;
}

Places moved(Places places, Place by) {
  for (Place& p : places) p += by;
  return places;
}

Places turned(Places places, Place round, double angle_rad) {
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  for (Place& p : places) {
    const Place d = p - round;
    p = {round.x + d.x * cosine - d.y * sine, round.y + d.x * sine + d.y * cosine};
  }
  return places;
}

}  // namespace repose::testing
