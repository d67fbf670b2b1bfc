#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vision/drawing/overlay.h"

/// What a report says, before it becomes a page: chapters of text, tables, charts and pictures.

namespace repose::calibrate::report {

/// Nothing, a number, or text.
using Cell = std::variant<std::monostate, double, std::string>;

struct Column {
  std::string name;
  std::string unit;                  ///< "" without one
  std::optional<int> decimals = {};  ///< as shown; without it four significant digits
};

/// Rows of named columns: what a chart draws, a page shows and a CSV file holds.
struct DataTable {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;

  void add(std::vector<Cell> row) { rows.push_back(std::move(row)); }
};

/// How a part of a chart looks. Each differs from the others in black and white, too.
enum class Look {
  runs,      ///< small open circles
  dots,      ///< filled circles
  points,    ///< filled markers, joined by a line
  fit,       ///< a strong line
  band,      ///< a light band from `low` to `high`
  scatter,   ///< thin dotted lines at `low` and `high`
  measured,  ///< a dashed level with a band
  best,      ///< a large diamond, with its interval where there is one
  limit,     ///< a thin dash-dotted level
  line,      ///< one of several alike lines, each with its dashes and marker
  grid,      ///< heights over a grid: contours
  ridge,     ///< where the surface has the measured value
};

/// The rows of a chart's table whose first column is `series`, which is also its name in the
/// legend.
struct Layer {
  std::string series;
  Look look = Look::points;
};

enum class ChartKind {
  plane,    ///< columns: series, x, y, and low, high where a look needs them
  contour,  ///< columns: series, x, y, z
  heap,     ///< columns: series, kind, three coordinates or corners, a rotation w x y z
};

/// Of red, green and blue, 0 to 1.
using ChartColour = std::array<double, 3>;

struct Chart {
  std::string name;  ///< of its CSV file; letters, digits and _
  ChartKind kind = ChartKind::plane;
  std::string title;
  std::string caption;  ///< what to see in it
  std::string x_title;  ///< with unit
  std::string y_title;
  std::string z_title;
  std::optional<std::array<double, 2>> y_range = {};
  bool has_whole_x = false;                ///< x counts something
  std::optional<ChartColour> colour = {};  ///< of grains; none: brown
  std::vector<Layer> layers = {};
  DataTable data = {};
};

/// Charts beside each other as far as the page is wide.
struct ChartRow {
  std::vector<Chart> charts;
};

/// One of the page's contour charts at a time, as a surface that can be turned.
struct SurfaceViewer {
  std::string caption;
};

struct Table {
  std::string name;  ///< of its CSV file; empty: none
  std::string title;
  DataTable data;
  /// Columns by place: value, low, high, min, max. Drawn as a strip from min to max at each row's
  /// end.
  std::optional<std::array<std::size_t, 5>> strip = {};
};

/// JPEG in the page itself.
struct ShownPicture {
  std::string data_uri;
  int width = 0;
  int height = 0;
  std::string alt;
  std::string caption;
  /// Of the picture that it shows, whose pixels are told where one points; 0: they are not.
  int picture_width = 0;
  int picture_height = 0;
  vision::OverlaidArea area = {};
  std::string command = {};  ///< that gives the same; empty: none
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
  bool is_appendix = false;  ///< for who wants to check: after all others
};

struct Document {
  std::string title;
  std::string kind;   ///< "Calibration", "Angles of repose"
  std::string state;  ///< "" or why this is not the whole story
  std::vector<Chapter> chapters;
  std::string program;
};

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
