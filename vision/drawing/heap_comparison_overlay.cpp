#include "vision/drawing/heap_comparison_overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/compare/heap_comparison.h"
#include "vision/drawing/canvas.h"
#include "vision/drawing/comparison_style.h"
#include "vision/picture/opencv.h"
#include "vision/picture/picture.h"

namespace repose::vision {

namespace {

std::string outline_text(const HeapComparison& comparison) {
  if (!comparison.iou) return "no side is in both pictures: outlines not compared";
  return fmt::format("overlap (IoU) {:.3f} · heights differ by {} (root mean square)",
                     *comparison.iou, length_text(*comparison.profile_rmse, comparison.unit));
}

std::string heap_text(const HeapComparison& comparison, const ComparisonOverlayNotes& notes,
                      std::size_t heap) {
  const std::optional<double>& angle_rad = comparison.angle_rad[heap];
  if (!angle_rad) return notes.titles[heap] + " · angle refused";
  return fmt::format("{} · {}", notes.titles[heap],
                     angle_text(*angle_rad, comparison.uncertainty_rad[heap]));
}

/// A white bar of `width` pixels: which line is which heap, the numbers, the verdict, the warnings.
cv::Mat draw_legend(int width, const HeapComparison& comparison,
                    const ComparisonOverlayNotes& notes, const Lettering& lettering) {
  std::vector<TextRow> rows;
  for (const int heap : {0, 1}) {
    rows.push_back({heap_text(comparison, notes, static_cast<std::size_t>(heap)), kInk, heap});
  }
  rows.push_back({difference_text(comparison.angle, notes.margin_rad), kInk});
  rows.push_back({outline_text(comparison), kInk});
  for (const CompareWarning& warning : comparison.warnings) {
    const char* whose = !warning.picture ? "" : *warning.picture == 0 ? "first: " : "second: ";
    rows.push_back({fmt::format("⚠ {}{}", whose, warning.warning.message), kFaint});
  }
  return draw_text_rows(width, rows, lettering);
}

constexpr int kWidth = 1400;  // px of the chart

constexpr int kHighest = 1400;  // px; only an extremely tall heap would need more

constexpr double kRoundOutlines = 0.08;  // margin around the outlines, of their width

constexpr double kFaded = 0.3;  // remaining fraction of the picture's contrast

/// Maps positions in the comparison's unit to the first picture.
class Stage {
 public:
  Stage(const ReposeAngle& first, const HeapComparison& comparison)
      : axis_(comparison.axis_px[0]), px_per_unit_(1 / comparison.unit_per_px[0]) {
    const cv::Point2d ground(first.ground->to.x - first.ground->from.x,
                             first.ground->to.y - first.ground->from.y);
    const double length = std::max(1e-9, cv::norm(ground));
    cos_ = ground.x / length;
    sin_ = ground.y / length;
  }

  Point picture(const OutlinePoint& point) const {
    const double along = point.along * px_per_unit_;
    const double height = point.height * px_per_unit_;
    return {axis_.x + along * cos_ + height * sin_, axis_.y + along * sin_ - height * cos_};
  }
  std::vector<Point> picture(const std::vector<OutlinePoint>& outline) const {
    std::vector<Point> points;
    for (const OutlinePoint& point : outline) points.push_back(picture(point));
    return points;
  }

 private:
  Point axis_;
  double px_per_unit_;
  double cos_ = 1;
  double sin_ = 0;
};

/// The upper edge, and down to the ground if the foot is visible.
std::vector<OutlinePoint> drawn_outline(const HeapComparison& comparison, std::size_t heap) {
  std::vector<OutlinePoint> outline = comparison.outlines[heap];
  const OutlinePoint first = outline.front();
  if (comparison.left.run_out[heap]) outline.insert(outline.begin(), {first.along, 0});
  if (comparison.right.run_out[heap]) outline.push_back({outline.back().along, 0});
  return outline;
}

/// The visible part of the picture [px].
cv::Rect2d shown_part(const Stage& stage, const HeapComparison& comparison) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double left = kFar, right = -kFar, top = kFar, bottom = -kFar;
  const auto include = [&](const Point& point) {
    left = std::min(left, point.x);
    right = std::max(right, point.x);
    top = std::min(top, point.y);
    bottom = std::max(bottom, point.y);
  };
  for (const auto& outline : comparison.outlines) {
    for (const OutlinePoint& point : outline) {
      include(stage.picture(point));
      include(stage.picture(OutlinePoint{point.along, 0}));
    }
  }
  const double margin = std::max(1.0, kRoundOutlines * (right - left));
  return {left - margin, top - margin, right - left + 2 * margin, bottom - top + 2 * margin};
}

/// The part of the picture in grey at `scale`, faded towards white.
cv::Mat faded(const Picture& picture, const cv::Rect2d& part, double scale, cv::Size size) {
  cv::Mat chart(size, CV_8UC3, kWhite);
  const cv::Point first(static_cast<int>(std::floor(std::max(0.0, part.x))),
                        static_cast<int>(std::floor(std::max(0.0, part.y))));
  const cv::Point last(static_cast<int>(std::ceil(std::min<double>(picture.width, part.br().x))),
                       static_cast<int>(std::ceil(std::min<double>(picture.height, part.br().y))));
  if (last.x <= first.x || last.y <= first.y) return chart;
  cv::Mat grey;
  cv::cvtColor(mat_of(picture)(cv::Rect(first, last)), grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_8U, kFaded, 255 * (1 - kFaded));
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
  const cv::Size drawn(std::max(1, cvRound(grey.cols * scale)),
                       std::max(1, cvRound(grey.rows * scale)));
  cv::resize(grey, grey, drawn, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  const cv::Point corner(cvRound((first.x - part.x) * scale), cvRound((first.y - part.y) * scale));
  const cv::Rect target = cv::Rect(corner, drawn) & cv::Rect({}, size);
  if (target.empty()) return chart;
  grey(cv::Rect(target.tl() - corner, target.size())).copyTo(chart(target));
  return chart;
}

void draw_axis(const Canvas& canvas, const Stage& stage, const HeapComparison& comparison,
               const Lettering& lettering) {
  const double top = 1.1 * std::max(*comparison.height[0], *comparison.height[1]);
  const cv::Point2d high = canvas.at(stage.picture(OutlinePoint{0, top}));
  canvas.draw_dashed({canvas.at(stage.picture(OutlinePoint{0, 0})), high}, kFaint, 0.2, 0.005);
  const int height = cvRound(canvas.length(0.026));
  const char* text = comparison.is_aligned_by_crest ? "crests" : "axis";
  lettering.draw(canvas.image(), text,
                 cv::Point(cvRound(high.x) - lettering.width(text, height) / 2,
                           cvRound(high.y) - height - height / 3),
                 height, kFaint);
}

void draw_ground(const Canvas& canvas, const Stage& stage, const HeapComparison& comparison) {
  double from = 0, to = 0;
  for (const auto& outline : comparison.outlines) {
    from = std::min(from, outline.front().along);
    to = std::max(to, outline.back().along);
  }
  const double beyond = kRoundOutlines / 2 * (to - from);
  canvas.draw({canvas.at(stage.picture(OutlinePoint{from - beyond, 0})),
               canvas.at(stage.picture(OutlinePoint{to + beyond, 0}))},
              kFaint, 0.4);
}

/// Both outlines, ground line, axis and, if there is a scale, a scale bar, on the faded first
/// picture.
cv::Mat draw_chart(const Picture& first, const ReposeAngle& first_measured,
                   const HeapComparison& comparison, const Lettering& lettering) {
  const Stage stage(first_measured, comparison);
  const cv::Rect2d part = shown_part(stage, comparison);
  const double scale = std::min(kWidth / part.width, kHighest / part.height);
  const cv::Size size(kWidth, std::clamp(cvRound(part.height * scale), 1, kHighest));
  cv::Mat image = faded(first, part, scale, size);
  Canvas canvas(image, scale, kWhite);
  canvas.set_corner({part.x, part.y});
  draw_ground(canvas, stage, comparison);
  draw_axis(canvas, stage, comparison, lettering);
  for (const std::size_t heap : {0, 1}) {
    draw_heap_line(canvas, canvas.path_of(stage.picture(drawn_outline(comparison, heap))), heap);
  }
  if (comparison.unit == LengthUnit::metre) {
    draw_scale_bar(canvas, scale / comparison.unit_per_px[0], lettering);
  }
  return image;
}

}  // namespace

Picture draw_comparison(const Picture& first, const ReposeAngle& first_measured,
                        const HeapComparison& comparison, const ComparisonOverlayNotes& notes) {
  if (first.empty()) {
    throw base::InputError({.where = "overlay",
                            .value = "the picture has no pixels",
                            .fix = "give the first picture that was compared."});
  }
  if (comparison.status == MeasureStatus::refused) {
    throw base::InputError(
        {.where = "overlay", .value = "the comparison was refused", .fix = comparison.reason});
  }
  const Lettering lettering;
  const cv::Mat chart = draw_chart(first, first_measured, comparison, lettering);
  const cv::Mat legend = draw_legend(chart.cols, comparison, notes, lettering);
  Picture overlay = blank_picture(chart.cols, chart.rows + legend.rows);
  cv::Mat whole = mat_of(overlay);
  chart.copyTo(whole(cv::Rect({0, 0}, chart.size())));
  legend.copyTo(whole(cv::Rect({0, chart.rows}, legend.size())));
  return overlay;
}

}  // namespace repose::vision
