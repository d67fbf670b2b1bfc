#include "tests/bench/line_panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace repose::bench {
namespace {

constexpr std::array<const char*, 4> kColours = {"#1b6ca8", "#c2571a", "#3f8f4f", "#7a4b9a"};
constexpr double kLeft = 60, kTop = 50, kHeight = 300, kWidth = 270, kGap = 30, kBelow = 50;
constexpr double kStep = 10;  // of the vertical axis

struct Span {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  void hold(double value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
};

/// Range of all intervals, rounded out to steps of the axis.
Span heights(const std::vector<Panel>& panels) {
  Span span;
  for (const Panel& panel : panels) {
    for (const PanelLine& line : panel.lines) {
      for (const PanelPoint& point : line.points) {
        span.hold(point.y - point.half);
        span.hold(point.y + point.half);
      }
    }
  }
  return {kStep * std::floor(span.from / kStep), kStep * std::ceil(span.to / kStep)};
}

std::string text(double x, double y, const char* anchor, const std::string& words,
                 const char* weight = "normal") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-weight=\"{}\">{}</text>\n", x, y,
      anchor, weight, words);
}

std::string stroke(double x1, double y1, double x2, double y2, const char* colour, double width) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
      "stroke-width=\"{:g}\"/>\n",
      x1, y1, x2, y2, colour, width);
}

/// One panel at its place in the picture.
class Drawing {
 public:
  Drawing(const Panel& panel, double left, Span y) : panel_(panel), left_(left), y_(y) {
    for (const double tick : panel.ticks) x_.hold(std::log(tick));
    for (const PanelLine& line : panel.lines) {
      for (const PanelPoint& point : line.points) x_.hold(std::log(point.x));
    }
    constexpr double kMargin = .06;
    const double margin = kMargin * std::max(x_.to - x_.from, 1e-3);
    x_ = {x_.from - margin, x_.to + margin};
  }

  std::string svg(bool has_numbers) const {
    std::string out = text(left_, kTop - 12, "start", panel_.title, "bold");
    for (double y = y_.from; y <= y_.to; y += kStep) {
      out += stroke(left_, at_y(y), left_ + kWidth, at_y(y), "#ddd", 1);
      if (has_numbers) out += text(left_ - 8, at_y(y) + 5, "end", fmt::format("{:g}", y));
    }
    for (const double tick : panel_.ticks) {
      out += stroke(at_x(tick), kTop + kHeight, at_x(tick), kTop + kHeight + 5, "#222", 1);
      out += text(at_x(tick), kTop + kHeight + 21, "middle", fmt::format("{:g}", tick));
    }
    for (std::size_t k = 0; k < panel_.lines.size(); ++k) {
      out += line_svg(panel_.lines[k], kColours[k % kColours.size()]);
    }
    return out;
  }

 private:
  double at_x(double x) const {
    return left_ + kWidth * (std::log(x) - x_.from) / (x_.to - x_.from);
  }
  double at_y(double y) const { return kTop + kHeight * (y_.to - y) / (y_.to - y_.from); }

  std::string place(const PanelPoint& point, double side) const {
    return fmt::format("{:.1f},{:.1f} ", at_x(point.x), at_y(point.y + side * point.half));
  }

  std::string line_svg(const PanelLine& line, const char* colour) const {
    std::string upper, lower, middle, marks;
    for (const PanelPoint& point : line.points) {
      upper += place(point, 1);
      lower = place(point, -1) + lower;
      middle += place(point, 0);
      marks += stroke(at_x(point.x), at_y(point.y - point.half), at_x(point.x),
                      at_y(point.y + point.half), colour, 1.5);
      marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n",
                           at_x(point.x), at_y(point.y), colour);
    }
    return fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.15\"/>\n",
                       upper + lower, colour) +
           fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                       middle, colour) +
           marks;
  }

  const Panel& panel_;
  double left_;
  Span x_;
  Span y_;
};

std::string legend(const std::vector<PanelLine>& lines, double y) {
  constexpr double kEach = 240, kMark = 24;
  std::string out;
  double x = kLeft;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    out += stroke(x, y - 5, x + kMark, y - 5, kColours[k % kColours.size()], 3);
    out += text(x + kMark + 6, y, "start", lines[k].name);
    x += kEach;
  }
  return out;
}

}  // namespace

std::string panels_svg(const std::vector<Panel>& panels, const std::string& y_title) {
  const auto count = static_cast<double>(panels.size());
  const double width = kLeft + count * (kWidth + kGap);
  const double height = kTop + kHeight + kBelow + 30;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#fff\"/>\n",
      width, height);
  out += text(kLeft - 45, 18, "start", y_title);
  const Span y = heights(panels);
  double left = kLeft;
  for (const Panel& panel : panels) {
    out += Drawing(panel, left, y).svg(&panel == &panels.front());
    left += kWidth + kGap;
  }
  if (!panels.empty()) out += legend(panels.front().lines, kTop + kHeight + kBelow + 12);
  return out + "</svg>\n";
}

}  // namespace repose::bench
