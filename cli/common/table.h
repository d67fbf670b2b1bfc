#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vision/measure/repose_angle.h"

/// Terminal output: tables and paragraphs, wrapped to its width. Characters are counted as UTF-8.
/// Control characters are escaped in all texts.

namespace repose::cli {

/// Shown for missing numbers.
inline constexpr const char* kMissing = "–";
/// Indent of notes below a row.
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

/// Columns are as wide as their widest cell. If the table is wider than the terminal, the last
/// column is wrapped if left-aligned, and a cell of the first column that does not fit gets its own
/// line.
class Table {
 public:
  explicit Table(std::vector<Column> columns);

  /// Cells omitted at the end are empty. The last one may have a colour, which does not count
  /// towards its width.
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

/// A text wrapped to the terminal: its first line follows `mark`, the others are indented to match.
std::string paragraph(std::string_view mark, std::string_view text, int terminal_columns);

/// A sequence of tables and paragraphs for a terminal of a given width.
class Page {
 public:
  explicit Page(int terminal_columns) : columns_(terminal_columns) {}

  void add_gap() { text_ += '\n'; }
  void add(const Table& table) { text_ += table.text(columns_); }
  void add(std::string_view text) { add("", text); }
  /// Lines to be copied: added unchanged, each with its line end.
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
