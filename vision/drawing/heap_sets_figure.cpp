#include "vision/drawing/heap_sets_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/compare/heap_sets.h"
#include "vision/drawing/canvas.h"
#include "vision/drawing/comparison_style.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

/// An axis between two whole degrees.
struct Axis {
  double from_deg = 0;
  double to_deg = 1;
  double left_px = 0;
  double width_px = 1;

  double at(double degrees) const {
    return left_px + width_px * (degrees - from_deg) / (to_deg - from_deg);
  }
};

Axis axis_for(int width, const std::array<SetOfHeaps, 2>& sets) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto include = [&](double angle_rad) {
    low = std::min(low, to_degrees(angle_rad));
    high = std::max(high, to_degrees(angle_rad));
  };
  for (const SetOfHeaps& set : sets) {
    for (const std::optional<double>& angle : set.angle_rad) {
      if (angle) include(*angle);
    }
    if (!set.mean_rad) continue;
    include(*set.mean_rad - set.uncertainty_rad.value_or(0));
    include(*set.mean_rad + set.uncertainty_rad.value_or(0));
  }
  constexpr double kSide = 0.06;  // of the width
  return {.from_deg = std::floor(low),
          .to_deg = std::max(std::ceil(high), std::floor(low) + 1),
          .left_px = kSide * width,
          .width_px = (1 - 2 * kSide) * width};
}

void draw_set(const Canvas& canvas, const Axis& axis, const SetOfHeaps& set, std::size_t number,
              double y, double row) {
  const double radius = row / 7;
  const cv::Scalar colour = number == 0 ? kInk : kVermilion;
  for (const std::optional<double>& angle : set.angle_rad) {
    if (!angle) continue;
    const cv::Point centre(cvRound(axis.at(to_degrees(*angle))), cvRound(y - row / 5));
    cv::circle(canvas.image(), centre, cvRound(radius), colour, cvRound(row / 18), cv::LINE_AA);
  }
  if (!set.mean_rad) return;
  const double mean = axis.at(to_degrees(*set.mean_rad));
  const double below = y + row / 5;
  if (set.uncertainty_rad) {
    const double reach = to_degrees(*set.uncertainty_rad);
    draw_heap_line(canvas,
                   {{axis.at(to_degrees(*set.mean_rad) - reach), below},
                    {axis.at(to_degrees(*set.mean_rad) + reach), below}},
                   number);
  }
  canvas.draw({{mean, below - row / 6}, {mean, below + row / 6}}, colour, 1.6);
}

void draw_axis(const Canvas& canvas, const Axis& axis, double y, int letters,
               const Lettering& lettering) {
  canvas.draw({{axis.at(axis.from_deg), y}, {axis.at(axis.to_deg), y}}, kFaint, 0.4);
  const double span = axis.to_deg - axis.from_deg;
  const double step = span <= 12 ? 1 : span <= 30 ? 2 : 5;
  for (double degree = axis.from_deg; degree <= axis.to_deg; degree += step) {
    const double x = axis.at(degree);
    canvas.draw({{x, y}, {x, y + letters / 4.0}}, kFaint, 0.4);
    const std::string text = fmt::format("{:g}°", degree);
    lettering.draw(canvas.image(), text,
                   {cvRound(x) - lettering.width(text, letters) / 2, cvRound(y) + letters / 2},
                   letters, kFaint);
  }
}

/// One row per set above an axis of degrees: every heap's angle as a circle, the mean as a bar with
/// its 95 % interval.
cv::Mat draw_angle_strip(int width, const std::array<SetOfHeaps, 2>& sets,
                         const Lettering& lettering) {
  const int letters = std::max(14, width / 60);
  const double row = 3.0 * letters;
  cv::Mat image(cvRound(2 * row) + 3 * letters, width, CV_8UC3, kWhite);
  const Canvas canvas(image, 1, kWhite);
  const Axis axis = axis_for(width, sets);
  for (const std::size_t set : {0, 1}) {
    draw_set(canvas, axis, sets[set], set, (static_cast<double>(set) + 0.5) * row + letters / 2.0,
             row);
  }
  draw_axis(canvas, axis, 2 * row + letters, letters, lettering);
  return image;
}

constexpr double kBeyond = 0.06;  // of the outlines' width

constexpr double kBandOpacity = 0.3;  // of its colour

/// Maps positions along the ground and heights above it to the chart.
class Chart {
 public:
  Chart(int width, const SetComparison& comparison) {
    double from = 0, to = 0, top = 0;
    for (const SetOfHeaps& set : comparison.sets) {
      for (const auto* line : {&set.outline.mean, &set.outline.high}) {
        for (const OutlinePoint& point : *line) {
          from = std::min(from, point.along);
          to = std::max(to, point.along);
          top = std::max(top, point.height);
        }
      }
    }
    const double margin = kBeyond * (to - from);
    px_per_unit_ = width / (to - from + 2 * margin);
    corner_ = {from - margin, top + margin};
    const double rows = (top + 2 * margin) * px_per_unit_;
    size_ = {width, std::clamp(cvRound(rows), 1, width)};
  }

  cv::Size size() const { return size_; }
  double px_per_unit() const { return px_per_unit_; }
  cv::Point2d at(const OutlinePoint& point) const {
    return {(point.along - corner_.x) * px_per_unit_, (corner_.y - point.height) * px_per_unit_};
  }

 private:
  double px_per_unit_ = 1;
  cv::Point2d corner_;
  cv::Size size_;
};

/// Without the ground beside the heap.
Path outline_path(const Chart& chart, const std::vector<OutlinePoint>& outline) {
  const auto is_heap = [](const OutlinePoint& point) { return point.height > 0; };
  const auto first = std::find_if(outline.begin(), outline.end(), is_heap);
  const auto last = std::find_if(outline.rbegin(), outline.rend(), is_heap).base();
  Path path;
  if (first >= last) return path;
  for (auto point = first; point != last; ++point) path.push_back(chart.at(*point));
  path.insert(path.begin(), chart.at({first->along, 0}));
  path.push_back(chart.at({std::prev(last)->along, 0}));
  return path;
}

void fill_band(cv::Mat& image, const Chart& chart, const MeanOutline& outline,
               const cv::Scalar& colour) {
  if (outline.low.empty()) return;
  std::vector<cv::Point> corners;
  for (const OutlinePoint& point : outline.high) corners.emplace_back(chart.at(point));
  for (auto point = outline.low.rbegin(); point != outline.low.rend(); ++point) {
    corners.emplace_back(chart.at(*point));
  }
  cv::Mat filled = image.clone();
  cv::fillPoly(filled, std::vector<std::vector<cv::Point>>{corners}, colour, cv::LINE_AA);
  cv::addWeighted(filled, kBandOpacity, image, 1 - kBandOpacity, 0, image);
}

/// The mean outlines of both sets with their bands on a white chart of `width` pixels.
cv::Mat draw_mean_outlines(int width, const SetComparison& comparison, const Lettering& lettering) {
  const Chart chart(width, comparison);
  cv::Mat image(chart.size(), CV_8UC3, kWhite);
  fill_band(image, chart, comparison.sets[0].outline, kFaint);
  fill_band(image, chart, comparison.sets[1].outline, kVermilion);
  const Canvas canvas(image, 1, kWhite);
  const double ground = chart.at({0, 0}).y;
  canvas.draw({{0, ground}, {static_cast<double>(width), ground}}, kFaint, 0.4);
  for (const std::size_t set : {0, 1}) {
    const Path path = outline_path(chart, comparison.sets[set].outline.mean);
    if (!path.empty()) draw_heap_line(canvas, path, set);
  }
  if (comparison.unit == LengthUnit::metre) {
    draw_scale_bar(canvas, chart.px_per_unit(), lettering);
  }
  return image;
}

std::string set_text(const SetOfHeaps& set, const std::string& title) {
  std::string text = fmt::format("{} · {} of {} heaps", title, set.counted, set.angle_rad.size());
  if (!set.mean_rad) return text + " · no angle";
  text += " · mean " + angle_text(*set.mean_rad, set.uncertainty_rad);
  if (set.sd_rad) text += fmt::format(" · heaps scatter by {:.1f}°", to_degrees(*set.sd_rad));
  return text;
}

std::string outline_text(const SetComparison& comparison) {
  if (!comparison.iou) return "a set has no whole outline: outlines not compared";
  return fmt::format(
      "mean outlines: overlap (IoU) {:.3f} · heights differ by {} · bands: 80 % of the "
      "pictures",
      *comparison.iou, length_text(*comparison.profile_rmse, comparison.unit));
}

std::vector<TextRow> rows_of(const SetComparison& comparison, const HeapSetsNotes& notes) {
  std::vector<TextRow> rows;
  for (const int set : {0, 1}) {
    const auto at = static_cast<std::size_t>(set);
    rows.push_back({set_text(comparison.sets[at], notes.titles[at]), kInk, set});
  }
  rows.push_back({difference_text(comparison.angle, notes.margin_rad), kInk});
  rows.push_back({outline_text(comparison), kInk});
  for (const Warning& warning : comparison.warnings) {
    rows.push_back({"⚠ " + warning.message, kFaint});
  }
  return rows;
}

}  // namespace

Picture draw_heap_sets(const SetComparison& comparison, const HeapSetsNotes& notes) {
  const Lettering lettering;
  std::vector<cv::Mat> parts;
  const bool has_outlines =
      !comparison.sets[0].outline.mean.empty() || !comparison.sets[1].outline.mean.empty();
  const bool has_angles = comparison.sets[0].mean_rad || comparison.sets[1].mean_rad;
  if (!has_outlines && !has_angles) {
    throw base::InputError({.where = "figure", .value = "neither set has an outline or an angle"});
  }
  if (has_outlines) parts.push_back(draw_mean_outlines(notes.width_px, comparison, lettering));
  if (has_angles) parts.push_back(draw_angle_strip(notes.width_px, comparison.sets, lettering));
  parts.push_back(draw_text_rows(notes.width_px, rows_of(comparison, notes), lettering));
  cv::Mat whole;
  cv::vconcat(parts, whole);
  Picture figure = blank_picture(whole.cols, whole.rows);
  whole.copyTo(mat_of(figure));
  return figure;
}

}  // namespace repose::vision
