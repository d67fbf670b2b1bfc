#include "vision/drawing/comparison_legend.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "vision/drawing/comparison_style.h"
#include "vision/drawing/text_rows.h"

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

}  // namespace

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

}  // namespace repose::vision
