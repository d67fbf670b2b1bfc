#pragma once

#include <string>
#include <vector>

namespace repose::bench {

/// A mean with its 95 % interval.
struct PanelPoint {
  double x = 0;
  double y = 0;
  double half = 0;  ///< half-width of the interval; 0: a single reading, which has none
};

struct PanelLine {
  std::string name;
  std::vector<PanelPoint> points;  ///< in order of increasing x
};

/// Lines over a logarithmic axis.
struct Panel {
  std::string title;
  std::vector<double> ticks;
  std::vector<PanelLine> lines;
};

/// Panels side by side as SVG, sharing a vertical axis and a legend: lines through the means,
/// bands and bars for the intervals.
std::string panels_svg(const std::vector<Panel>& panels, const std::string& y_title);

}  // namespace repose::bench
