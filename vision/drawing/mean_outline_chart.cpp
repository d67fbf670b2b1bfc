#include "vision/drawing/mean_outline_chart.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/drawing/comparison_style.h"

namespace repose::vision {
namespace {

constexpr double kBeyond = 0.06;      // of the outlines' width
constexpr double kBandOpacity = 0.3;  // of its colour

/// From places along the ground and heights above it to the chart.
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

}  // namespace

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

}  // namespace repose::vision
