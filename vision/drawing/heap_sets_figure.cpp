#include "vision/drawing/heap_sets_figure.h"

#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "vision/drawing/angle_strip.h"
#include "vision/drawing/comparison_style.h"
#include "vision/drawing/lettering.h"
#include "vision/drawing/mean_outline_chart.h"
#include "vision/drawing/text_rows.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

constexpr int kFigureWidth = 1400;

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
  if (has_outlines) parts.push_back(draw_mean_outlines(kFigureWidth, comparison, lettering));
  if (has_angles) parts.push_back(draw_angle_strip(kFigureWidth, comparison.sets, lettering));
  parts.push_back(draw_text_rows(kFigureWidth, rows_of(comparison, notes), lettering));
  cv::Mat whole;
  cv::vconcat(parts, whole);
  Picture figure = blank_picture(whole.cols, whole.rows);
  whole.copyTo(mat_of(figure));
  return figure;
}

}  // namespace repose::vision
