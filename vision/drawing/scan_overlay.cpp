#include "vision/drawing/scan_overlay.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "vision/drawing/canvas.h"
#include "vision/drawing/comparison_style.h"
#include "vision/drawing/track_drawing.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

constexpr int kPlanSide = 640, kChartWidth = 640, kChartHeight = 320, kLetters = 16;
constexpr int kContours = 10;
const cv::Scalar kUnseen{225, 225, 225};

/// From a pale base to a dark crest.
cv::Vec3b height_colour(double part) {
  const double t = std::clamp(part, 0.0, 1.0);
  const cv::Scalar low{235, 245, 250}, high{30, 90, 150};
  cv::Vec3b colour;
  for (int k = 0; k < 3; ++k) {
    colour[k] = cv::saturate_cast<std::uint8_t>(low[k] + t * (high[k] - low[k]));
  }
  return colour;
}

/// The heap from above, the second axis upwards.
class Plan {
 public:
  explicit Plan(const ScannedHeap& heap) : map_(heap.map) {
    for (std::size_t k = 0; k < map_.height.size(); ++k) {
      if (map_.is_heap[k] != 0 && !std::isnan(map_.height[k])) {
        highest_ = std::max(highest_, static_cast<double>(map_.height[k]));
      }
    }
  }

  cv::Mat drawn() const {
    cv::Mat image(kPlanSide, kPlanSide, CV_8UC3, kUnseen);
    for (int y = 0; y < kPlanSide; ++y) {
      for (int x = 0; x < kPlanSide; ++x) image.at<cv::Vec3b>(y, x) = colour(x, y);
    }
    const Canvas canvas(image, 1, kWhite);
    const double scale = kPlanSide / (map_.side * map_.cell);
    const cv::Point2d axis(map_.axis[0] * scale, kPlanSide - map_.axis[1] * scale);
    constexpr double kArm = 12;
    canvas.draw({axis - cv::Point2d(kArm, 0), axis + cv::Point2d(kArm, 0)}, kInk, .7);
    canvas.draw({axis - cv::Point2d(0, kArm), axis + cv::Point2d(0, kArm)}, kInk, .7);
    return image;
  }

 private:
  std::size_t cell_at(int x, int y) const {
    const int column = std::min(map_.side - 1, x * map_.side / kPlanSide);
    const int row = std::min(map_.side - 1, (kPlanSide - 1 - y) * map_.side / kPlanSide);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.side) +
           static_cast<std::size_t>(column);
  }
  int band(std::size_t cell) const {
    return static_cast<int>(
        std::floor(static_cast<double>(map_.height[cell]) / highest_ * kContours));
  }
  cv::Vec3b colour(int x, int y) const {
    const auto plain = [](const cv::Scalar& scalar) {
      return cv::Vec3b(cv::saturate_cast<std::uint8_t>(scalar[0]),
                       cv::saturate_cast<std::uint8_t>(scalar[1]),
                       cv::saturate_cast<std::uint8_t>(scalar[2]));
    };
    const std::size_t cell = cell_at(x, y);
    if (std::isnan(map_.height[cell])) return plain(kUnseen);
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}}) {
      const std::size_t next =
          cell_at(std::min(x + dx, kPlanSide - 1), std::min(y + dy, kPlanSide - 1));
      if (std::isnan(map_.height[next])) continue;
      if (map_.is_heap[cell] != map_.is_heap[next]) return plain(kVermilion);
      if (map_.is_heap[cell] != 0 && band(cell) != band(next)) return plain(kInk);
    }
    if (map_.is_hole[cell] != 0) return plain(kSkyBlue);
    return height_colour(map_.height[cell] / highest_);
  }

  const ScanMap& map_;
  double highest_ = 1e-12;
};

/// A chart's area and its two axes.
class ScanChart {
 public:
  ScanChart(Point low, Point high) : low_(low), high_(high) {}

  cv::Mat blank() const { return {kChartHeight, kChartWidth, CV_8UC3, kWhite}; }
  cv::Point2d at(double x, double y) const {
    constexpr double kLeft = 60, kRight = 20, kTop = 34, kBottom = 40;
    const double across = (x - low_.x) / (high_.x - low_.x);
    const double up = (y - low_.y) / (high_.y - low_.y);
    return {kLeft + across * (kChartWidth - kLeft - kRight),
            kChartHeight - kBottom - up * (kChartHeight - kTop - kBottom)};
  }
  void draw_frame(const Canvas& canvas) const {
    canvas.draw({at(low_.x, high_.y), at(low_.x, low_.y), at(high_.x, low_.y)}, kFaint, .4);
  }

 private:
  Point low_, high_;
};

void write_beside(cv::Mat& image, const Lettering& lettering, const std::string& text,
                  cv::Point2d at, double left_part, int down) {
  const int width = lettering.width(text, kLetters);
  lettering.draw(image, text, {cvRound(at.x - left_part * width), cvRound(at.y) + down}, kLetters,
                 kInk);
}

cv::Mat azimuth_chart(const ScannedHeap& heap, const Lettering& lettering) {
  constexpr double kWhole = 360, kMargin = 1;
  double low = 90, high = 0;
  for (const Azimuth& azimuth : heap.azimuths) {
    if (!azimuth.angle_rad) continue;
    low = std::min(low, to_degrees(*azimuth.angle_rad));
    high = std::max(high, to_degrees(*azimuth.angle_rad));
  }
  if (low > high) low = 0, high = 90;
  low = std::floor(low - kMargin);
  high = std::ceil(high + kMargin);
  const ScanChart chart({0, low}, {kWhole, high});
  cv::Mat image = chart.blank();
  const Canvas canvas(image, 1, kWhite);
  chart.draw_frame(canvas);
  write_beside(image, lettering, "flank's angle over azimuth", {kChartWidth / 2.0, 0}, .5, 6);
  for (const double degree : {low, high}) {
    write_beside(image, lettering, fmt::format("{:.0f}°", degree), chart.at(0, degree), 1.2, -8);
  }
  for (const int azimuth : {0, 90, 180, 270, 360}) {
    write_beside(image, lettering, fmt::format("{}°", azimuth), chart.at(azimuth, low), .5, 10);
  }
  if (heap.angle.angle_rad) {
    const double mean = to_degrees(*heap.angle.angle_rad);
    const double half = to_degrees(heap.angle.uncertainty_rad.value_or(0));
    canvas.draw({chart.at(0, mean), chart.at(kWhole, mean)}, kVermilion, .8);
    for (const double edge : {mean - half, mean + half}) {
      canvas.draw_dashed({chart.at(0, edge), chart.at(kWhole, edge)}, kVermilion, .4);
    }
  }
  for (const Azimuth& azimuth : heap.azimuths) {
    if (!azimuth.angle_rad) continue;
    cv::circle(image, chart.at(to_degrees(azimuth.azimuth_rad), to_degrees(*azimuth.angle_rad)), 3,
               kInk, cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat profile_chart(const ScannedHeap& heap, const Lettering& lettering) {
  double width = 1e-12, height = 1e-12;
  for (const Point& point : heap.mean_profile) {
    width = std::max(width, point.x);
    height = std::max(height, point.y);
  }
  constexpr double kRoom = 1.1;
  const ScanChart chart({0, 0}, {kRoom * width, kRoom * height});
  cv::Mat image = chart.blank();
  const Canvas canvas(image, 1, kWhite);
  chart.draw_frame(canvas);
  write_beside(image, lettering, "mean profile from the axis, and a line over the window",
               {kChartWidth / 2.0, 0}, .5, 6);
  for (const double part : heap.angle.window) {
    const double level = part * height;
    canvas.draw_dashed({chart.at(0, level), chart.at(kRoom * width, level)}, kFaint, .4);
    write_beside(image, lettering, fmt::format("{:.0f} %", 100 * part), chart.at(0, level), 1.1,
                 -8);
  }
  Path path;
  for (const Point& point : heap.mean_profile) path.push_back(chart.at(point.x, point.y));
  canvas.draw(path, kInk, 1);
  if (heap.mean_line) {
    const Segment& line = *heap.mean_line;
    canvas.draw({chart.at(line.from.x, line.from.y), chart.at(line.to.x, line.to.y)}, kVermilion,
                1);
  }
  return image;
}

std::string numbers_text(const ScannedHeap& heap) {
  std::string text = fmt::format("window {:.0f}–{:.0f} % of the height", 100 * heap.angle.window[0],
                                 100 * heap.angle.window[1]);
  if (heap.azimuth_sd_rad) {
    text += fmt::format(" · azimuths scatter by {:.1f}°", to_degrees(*heap.azimuth_sd_rad));
  }
  const auto add = [&](const char* name, const std::optional<Estimate>& size, const char* unit) {
    if (size)
      text += fmt::format(" · {} {:.4g} ± {:.2g} {}", name, size->value, size->uncertainty, unit);
  };
  add("height", heap.height_mm, "mm");
  add("base", heap.base_mm, "mm");
  add("volume", heap.volume_ml, "ml");
  return text + fmt::format(" · {} points", heap.points);
}

std::vector<TextRow> rows_of(const ScannedHeap& heap, const std::string& title) {
  const ReposeAngle& angle = heap.angle;
  std::string head = title + " · " + name_of(angle.status);
  if (angle.angle_rad) head += " · " + angle_text(*angle.angle_rad, angle.uncertainty_rad);
  std::vector<TextRow> rows = {{std::move(head), kInk}};
  if (angle.status == MeasureStatus::refused) rows.push_back({angle.reason, kVermilion});
  rows.push_back({numbers_text(heap), kFaint});
  for (const Warning& warning : angle.warnings) rows.push_back({warning.message, kVermilion});
  return rows;
}

}  // namespace

Picture draw_scan_overlay(const ScannedHeap& heap, const std::string& title) {
  const Lettering lettering;
  cv::Mat image(kPlanSide, kPlanSide + kChartWidth, CV_8UC3, kWhite);
  if (heap.map.side > 0) {
    Plan(heap).drawn().copyTo(image(cv::Rect(0, 0, kPlanSide, kPlanSide)));
    azimuth_chart(heap, lettering).copyTo(image(cv::Rect(kPlanSide, 0, kChartWidth, kChartHeight)));
    profile_chart(heap, lettering)
        .copyTo(image(cv::Rect(kPlanSide, kChartHeight, kChartWidth, kChartHeight)));
  }
  return with_caption(image, rows_of(heap, title), lettering);
}

}  // namespace repose::vision
