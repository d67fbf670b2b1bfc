#include "calibrate/report/document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/report/wording.h"

namespace repose::calibrate::report {

namespace {

std::string title_of(const Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

/// The fraction of the way from a to b at which the value lies, if it does.
std::optional<double> crossing(double a, double b, double value) {
  if (!std::isfinite(a) || !std::isfinite(b) || (a < value) == (b < value)) return std::nullopt;
  return (value - a) / (b - a);
}

}  // namespace

Chart plane_chart(const std::string& name, const std::string& title, const Column& x,
                  const Column& y) {
  return {.name = file_stem(name),
          .kind = ChartKind::plane,
          .title = title,
          .caption = {},
          .x_title = title_of(x),
          .y_title = title_of(y),
          .z_title = {},
          .data = {.columns = {{.name = "series", .unit = {}},
                               x,
                               y,
                               {.name = "low", .unit = {}},
                               {.name = "high", .unit = {}}},
                   .rows = {}}};
}

void add_point(Chart& chart, const std::string& series, Look look, Cell x, Cell y, Cell low,
               Cell high) {
  const bool is_known = std::any_of(chart.layers.begin(), chart.layers.end(),
                                    [&](const Layer& layer) { return layer.series == series; });
  if (!is_known) chart.layers.push_back({.series = series, .look = look});
  chart.data.add({series, std::move(x), std::move(y), std::move(low), std::move(high)});
}

void add_level(Chart& chart, const std::string& series, Look look, std::array<double, 2> x_range,
               double y, double low, double high) {
  for (const double x : x_range) add_point(chart, series, look, x, y, low, high);
}

std::vector<std::array<double, 2>> ridge_of(const std::vector<double>& x,
                                            const std::vector<double>& y,
                                            const std::vector<std::vector<double>>& heights,
                                            double value) {
  std::vector<std::array<double, 2>> places;
  for (std::size_t row = 0; row < y.size(); ++row) {
    for (std::size_t column = 0; column < x.size(); ++column) {
      const double here = heights[row][column];
      if (column + 1 < x.size()) {
        const auto fraction = crossing(here, heights[row][column + 1], value);
        if (fraction) places.push_back({std::lerp(x[column], x[column + 1], *fraction), y[row]});
      }
      if (row + 1 < y.size()) {
        const auto fraction = crossing(here, heights[row + 1][column], value);
        if (fraction) places.push_back({x[column], std::lerp(y[row], y[row + 1], *fraction)});
      }
    }
  }
  return places;
}

}  // namespace repose::calibrate::report
