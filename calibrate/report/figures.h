#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/report/document.h"

/// Charts, put together row by row.
namespace repose::calibrate::report {

/// An empty chart with the columns series, x, y, low, high.
Chart plane_chart(const std::string& name, const std::string& title, const Column& x,
                  const Column& y);

/// Adds a layer, unless it is there already, and one row of it.
void add_point(Chart& chart, const std::string& series, Look look, Cell x, Cell y, Cell low = {},
               Cell high = {});

/// A level over the chart's whole width, with a band from low to high.
void add_level(Chart& chart, const std::string& series, Look look, std::array<double, 2> x_range,
               double y, double low, double high);

/// Where a surface over a grid takes a value: the crossings of the lines between neighbours,
/// straight between them. `heights[row][column]` belongs to y[row], x[column].
std::vector<std::array<double, 2>> ridge_of(const std::vector<double>& x,
                                            const std::vector<double>& y,
                                            const std::vector<std::vector<double>>& heights,
                                            double value);

}  // namespace repose::calibrate::report
