#include "vision/drawing/text_rows.h"

#include <algorithm>

#include "vision/drawing/comparison_style.h"

namespace repose::vision {
namespace {

/// A line of a wrapped text.
struct PlacedLine {
  std::string text;
  cv::Scalar colour;
  int indent = 0;
  int heap = -1;
};

}  // namespace

cv::Mat draw_text_rows(int width, const std::vector<TextRow>& rows, const Lettering& lettering) {
  const int height = std::max(14, width / 52);
  const int pad = height;
  const int sample = 5 * height;
  std::vector<PlacedLine> lines;
  for (const TextRow& row : rows) {
    const int indent = row.heap >= 0 ? sample + pad : 0;
    int heap = row.heap;
    for (const std::string& text : lettering.wrap(row.text, height, width - 2 * pad - indent)) {
      lines.push_back({text, row.colour, indent, heap});
      heap = -1;
    }
  }
  const int line_height = height + height / 2;
  cv::Mat bar(static_cast<int>(lines.size()) * line_height + 2 * pad, width, CV_8UC3, kWhite);
  const Canvas canvas(bar, 1, kWhite);
  int y = pad;
  for (const PlacedLine& line : lines) {
    if (line.heap >= 0) {
      const double middle = y + height / 2.0;
      draw_heap_line(canvas, {{double(pad), middle}, {double(pad + sample), middle}},
                     static_cast<std::size_t>(line.heap));
    }
    lettering.draw(bar, line.text, {pad + line.indent, y}, height, line.colour);
    y += line_height;
  }
  return bar;
}

}  // namespace repose::vision
