#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vision/drawing/overlay.h"

/// The content of a report before it becomes a page: chapters of text, tables, charts and pictures.

namespace repose::calibrate::report {

/// Nothing, a number, or text.
using Cell = std::variant<std::monostate, double, std::string>;

struct Column {
  std::string name;
  std::string unit;                  ///< "" without one
  std::optional<int> decimals = {};  ///< as shown; std::nullopt: four significant digits
};

/// Rows of named columns, as drawn in a chart, shown in a page and saved in a CSV file.
struct DataTable {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;

  void add(std::vector<Cell> row) { rows.push_back(std::move(row)); }
};

/// The style of a chart's layer. All can be told apart in black and white, too.
enum class Look {
  runs,      ///< small open circles
  dots,      ///< filled circles
  points,    ///< filled markers, joined by a line
  fit,       ///< a strong line
  band,      ///< a light band from `low` to `high`
  scatter,   ///< thin dotted lines at `low` and `high`
  measured,  ///< a dashed level with a band
  best,      ///< a large diamond, with its interval if it has one
  limit,     ///< a thin dash-dotted level
  line,      ///< one of several similar lines, each with its own dashes and marker
  grid,      ///< heights over a grid: contours
  ridge,     ///< where the surface equals the measured value
};

/// The rows of a chart's table whose first column is `series`, which is also its name in the
/// legend.
struct Layer {
  std::string series;
  Look look = Look::points;
};

enum class ChartKind {
  plane,    ///< columns: series, x, y, and low, high if a look needs them
  contour,  ///< columns: series, x, y, z
  heap,     ///< columns: series, kind, three coordinates or corners, a rotation w x y z
};

/// Red, green and blue, 0 to 1.
using ChartColour = std::array<double, 3>;

struct Chart {
  std::string name;  ///< of its CSV file: letters, digits and _
  ChartKind kind = ChartKind::plane;
  std::string title;
  std::string caption;  ///< what to see in it
  std::string x_title;  ///< with unit
  std::string y_title;
  std::string z_title;
  std::optional<std::array<double, 2>> y_range = {};
  bool has_whole_x = false;                ///< x counts something
  std::optional<ChartColour> colour = {};  ///< of grains; std::nullopt: brown
  std::vector<Layer> layers = {};
  DataTable data = {};
};

/// Charts side by side, as many as fit the page's width.
struct ChartRow {
  std::vector<Chart> charts;
};

/// Shows one of the page's contour charts at a time as a rotatable surface.
struct SurfaceViewer {
  std::string caption;
};

struct Table {
  std::string name;  ///< of its CSV file; empty: none
  std::string title;
  DataTable data;
  /// Column indices of value, low, high, min, max, drawn as a strip from min to max at each row's
  /// end.
  std::optional<std::array<std::size_t, 5>> strip = {};
};

/// JPEG embedded in the page.
struct ShownPicture {
  std::string data_uri;
  int width = 0;
  int height = 0;
  std::string alt;
  std::string caption;
  /// Size of the measured picture, whose pixel coordinates are shown under the pointer; 0: not
  /// shown.
  int picture_width = 0;
  int picture_height = 0;
  vision::OverlaidArea area = {};
  std::string command = {};  ///< that gives the same picture; empty: none
};

struct PictureRow {
  std::vector<ShownPicture> pictures;
};

struct Heading {
  std::string text;
};
struct Paragraph {
  std::string text;
};
struct Equation {
  std::string text;
};
/// Something the reader must know before using a number.
struct Remark {
  std::string text;
};
/// To be copied.
struct CodeText {
  std::string label;
  std::string text;
};

using Block = std::variant<Heading, Paragraph, Equation, Remark, CodeText, Table, ChartRow,
                           SurfaceViewer, PictureRow>;

struct Chapter {
  std::string id;
  std::string title;
  std::vector<Block> blocks;
  bool is_appendix = false;  ///< for checking; placed after all other chapters
};

struct Document {
  std::string title;
  std::string kind;   ///< "Calibration", "Angles of repose"
  std::string state;  ///< "" or why the report is incomplete
  std::vector<Chapter> chapters;
  std::string program;
};

/// An empty chart with the columns series, x, y, low, high.
Chart plane_chart(const std::string& name, const std::string& title, const Column& x,
                  const Column& y);

/// Adds one row to a layer, which is added first if it does not exist.
void add_point(Chart& chart, const std::string& series, Look look, Cell x, Cell y, Cell low = {},
               Cell high = {});

/// A level over the chart's whole width, with a band from low to high.
void add_level(Chart& chart, const std::string& series, Look look, std::array<double, 2> x_range,
               double y, double low, double high);

/// Where a surface over a grid takes a value: crossings on the edges between neighbouring points,
/// linearly interpolated. `heights[row][column]` belongs to y[row], x[column].
std::vector<std::array<double, 2>> ridge_of(const std::vector<double>& x,
                                            const std::vector<double>& y,
                                            const std::vector<std::vector<double>>& heights,
                                            double value);

}  // namespace repose::calibrate::report
