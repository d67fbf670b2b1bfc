#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vision/measure/repose_angle.h"

/// What people read on a terminal: tables and paragraphs, as wide as it is. Letters are counted as
/// UTF-8. What would control the terminal is spelt out, whatever a text comes from.

namespace repose::cli {

/// Stands where a number does not exist.
inline constexpr const char* kMissing = "–";
/// Before what is said below a row.
inline constexpr const char* kNoteIndent = "  ";

enum class Align { left, right };
enum class Colour { none, green, yellow, red };

struct Column {
  std::string heading;
  Align align = Align::left;
  std::size_t min_width = 0;
};

inline Column number_column(std::string heading) {
  return {.heading = std::move(heading), .align = Align::right};
}

/// Columns as wide as their widest cell. Where that is wider than the terminal, the last column is
/// wrapped if it is aligned left, and a cell of the first that does not fit has a line of its own.
class Table {
 public:
  explicit Table(std::vector<Column> columns);

  /// Cells that are left out at the end are empty. The last one may have a colour, which takes no
  /// room.
  void add_row(std::vector<std::string> cells, Colour last = Colour::none);

  /// A paragraph below the last row.
  void add_note(std::string mark, std::string text);

  /// With a line of headings, unless all are empty.
  std::string text(int terminal_columns) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    Colour last = Colour::none;
    std::string mark = {}, note = {};
    bool is_note = false;
  };

  std::vector<std::size_t> widths(std::size_t available) const;
  void add_lines(const std::vector<std::string>& cells, Colour last,
                 const std::vector<std::size_t>& widths, std::string& text) const;

  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

/// A text wrapped to the terminal: its first line behind `mark`, the others below its beginning.
std::string paragraph(std::string_view mark, std::string_view text, int terminal_columns);

/// Tables and paragraphs below each other, for a terminal of some width.
class Page {
 public:
  explicit Page(int terminal_columns) : columns_(terminal_columns) {}

  void add_gap() { text_ += '\n'; }
  void add(const Table& table) { text_ += table.text(columns_); }
  void add(std::string_view text) { add("", text); }
  /// To be copied: as they are, each with its end.
  void add_lines(std::string_view lines) { text_ += lines; }
  void add(std::string_view mark, std::string_view text) {
    text_ += paragraph(mark, text, columns_);
  }

  const std::string& text() const { return text_; }

 private:
  int columns_;
  std::string text_;
};

inline Colour colour_of(vision::MeasureStatus status) {
  switch (status) {
    case vision::MeasureStatus::ok:
      return Colour::green;
    case vision::MeasureStatus::flagged:
      return Colour::yellow;
    case vision::MeasureStatus::refused:
      break;
  }
  return Colour::red;
}

}  // namespace repose::cli
