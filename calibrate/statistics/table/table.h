#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Tables with a header, exported from spreadsheets: CSV.
namespace repose::calibrate {

/// At most this many errors in rows are listed; the others are counted.
inline constexpr std::size_t kMaxRowErrors = 10;

struct TableRow {
  int line = 0;  ///< of the file, from 1
  std::vector<std::string> cells;
};

/// Contents of a CSV file, cell by cell; every row has as many cells as there are columns.
struct Table {
  std::string name;  ///< for messages
  std::vector<std::string> columns;
  std::vector<TableRow> rows;
  /// Cells are not separated by commas, so numbers are likely to have decimal commas.
  bool has_decimal_comma = false;
  /// The first column had no name, and numbers the rows: it is called "row".
  bool has_unnamed_row_numbers = false;
  char delimiter = ',';  ///< separates the cells; a semicolon for a table of one column

  std::optional<std::size_t> column(std::string_view wanted) const;
};

enum class NoRows { refused, allowed };

/// A column of numbers; each must lie between `above` and `below`.
struct NumberColumn {
  std::string name;
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
};

/// Reads RFC 4180 text, in UTF-8 with or without a byte order mark. The delimiter is given by a
/// first line "sep=;", otherwise it is the first of semicolon, tab and comma found in the header; a
/// header with none of them is a single column, whose commas are decimal ones. A first column
/// without a name that numbers the rows, as programs write it, is called "row". Empty rows and
/// columns are skipped, as are empty cells after the last column.
///
/// @throws base::InputError  every error, one per line: "NAME:LINE: ... Fix: ...": no header, no
/// rows, columns without a name or with the same name, rows with too few or too many cells,
/// unmatched quotes, invalid bytes, a spreadsheet's own file format.
Table parse_table(const std::string& name, std::string_view text, NoRows no_rows = NoRows::refused);

/// parse_table of a file's content.
Table read_table(const std::filesystem::path& file, NoRows no_rows = NoRows::refused);

/// The table's text, which parse_table reads back.
std::string csv_text(const Table& table);

/// A cell as a finite number, with a decimal point or comma; std::nullopt if it is not one.
std::optional<double> number_of(std::string_view cell);

/// "1.012", "12.345.678" for the mark '.': a number, or perhaps a thousand times as much.
bool may_have_thousands(std::string_view cell, char mark);

/// The lines on which `numbers_of` would report a cell.
std::set<int> unclear_lines(const Table& table, std::span<const NumberColumn> columns);

/// The numbers of some columns: [column][row]. The range is not checked: it only serves to
/// interpret "1.403".
///
/// @throws base::InputError  every error: missing columns, cells that are not finite numbers, or
/// whose point or comma may separate thousands, each with its line.
std::vector<std::vector<double>> numbers_of(const Table& table,
                                            std::span<const NumberColumn> columns);

}  // namespace repose::calibrate
