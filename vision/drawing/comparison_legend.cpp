#include "vision/drawing/comparison_legend.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "vision/drawing/comparison_style.h"

namespace repose::vision {
namespace {

struct Text {
  std::string text;
  cv::Scalar colour;
};

/// "4.1 mm", or a part of what both heaps were made equal in.
std::string length_text(double length, LengthUnit unit) {
  if (unit == LengthUnit::metre) return fmt::format("{:.3g} mm", length * 1000);
  return fmt::format("{:.1f} % of the {}", 100 * length,
                     unit == LengthUnit::height ? "height" : "area's square root");
}

std::string verdict_text(const std::optional<AngleDifference>& compared, double margin_rad) {
  if (!compared) return "an angle is refused: angles not compared";
  const AngleDifference& angle = *compared;
  const char* verdict = angle.verdict == Agreement::equivalent  ? "equivalent"
                        : angle.verdict == Agreement::different ? "different"
                                                                : "cannot tell";
  return fmt::format("angle difference {:.1f}° (95 %: {:.1f} to {:.1f}°): {} · margin {:g}°",
                     to_degrees(angle.difference_rad), to_degrees(angle.interval_rad[0]),
                     to_degrees(angle.interval_rad[1]), verdict, to_degrees(margin_rad));
}

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

std::vector<Text> remarks(const HeapComparison& comparison, const ComparisonOverlayNotes& notes) {
  std::vector<Text> texts = {{verdict_text(comparison.angle, notes.margin_rad), kInk},
                             {outline_text(comparison), kInk}};
  for (const CompareWarning& warning : comparison.warnings) {
    const char* whose = !warning.picture ? "" : *warning.picture == 0 ? "first: " : "second: ";
    texts.push_back({fmt::format("⚠ {}{}", whose, warning.warning.message), kFaint});
  }
  return texts;
}

}  // namespace

cv::Mat draw_legend(int width, const HeapComparison& comparison,
                    const ComparisonOverlayNotes& notes, const Lettering& lettering) {
  const int height = std::max(14, width / 52);
  const int pad = height;
  const int sample = 5 * height;
  struct Row {
    std::string text;
    cv::Scalar colour;
    int indent = 0;
    int heap = -1;  ///< whose line is drawn before it
  };
  std::vector<Row> rows;
  const auto add = [&](const Text& text, int indent, int heap) {
    for (const std::string& line : lettering.wrap(text.text, height, width - 2 * pad - indent)) {
      rows.push_back({line, text.colour, indent, heap});
      heap = -1;
    }
  };
  for (const int heap : {0, 1}) {
    add({heap_text(comparison, notes, static_cast<std::size_t>(heap)), kInk}, sample + pad, heap);
  }
  for (const Text& text : remarks(comparison, notes)) add(text, 0, -1);

  const int line_height = height + height / 2;
  cv::Mat bar(static_cast<int>(rows.size()) * line_height + 2 * pad, width, CV_8UC3, kWhite);
  const Canvas canvas(bar, 1, kWhite);
  int y = pad;
  for (const Row& row : rows) {
    if (row.heap >= 0) {
      const double middle = y + height / 2.0;
      draw_heap_line(canvas, {{double(pad), middle}, {double(pad + sample), middle}},
                     static_cast<std::size_t>(row.heap));
    }
    lettering.draw(bar, row.text, {pad + row.indent, y}, height, row.colour);
    y += line_height;
  }
  return bar;
}

}  // namespace repose::vision
