#include "calibrate/statistics/table/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

#include <csv.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/closest_word.h"
#include "base/error_list.h"
#include "base/whole_file.h"

namespace repose::calibrate {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// libcsv's parser. It is given line by line, so that a row's line is known.
class Parser {
 public:
  explicit Parser(char delimiter) {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    csv_set_delim(&parser_, static_cast<unsigned char>(delimiter));
  }
  ~Parser() { csv_free(&parser_); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
  Parser(Parser&&) = delete;
  Parser& operator=(Parser&&) = delete;

  /// False when the text breaks the rules of quoting.
  bool add_line(int number, const std::string& line) {
    if (!is_in_row_) {
      if (line.find_first_not_of(" \t\r\n") == std::string::npos) return true;
      is_in_row_ = true;
      row_.line = number;
    }
    return csv_parse(&parser_, line.data(), line.size(), add_cell, end_row, this) == line.size();
  }
  bool finish() { return csv_fini(&parser_, add_cell, end_row, this) == 0; }

  std::vector<TableRow> take_rows() { return std::exchange(rows_, {}); }

 private:
  static void add_cell(void* text, std::size_t size, void* self) {
    static_cast<Parser*>(self)->row_.cells.emplace_back(static_cast<const char*>(text), size);
  }
  static void end_row(int /*letter*/, void* self) {
    auto& parser = *static_cast<Parser*>(self);
    parser.rows_.push_back(std::exchange(parser.row_, {}));
    parser.is_in_row_ = false;
  }

  csv_parser parser_{};
  TableRow row_;
  bool is_in_row_ = false;
  std::vector<TableRow> rows_;
};

char delimiter_of(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \r\n");
  if (start == std::string_view::npos) return ',';
  const std::string_view header = text.substr(start, text.find('\n', start) - start);
  for (const char delimiter : {';', '\t'}) {
    if (header.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return ',';
}

std::vector<TableRow> rows_of(const std::string& name, std::string_view text, char delimiter) {
  Parser parser(delimiter);
  int line = 0;
  const auto refuse = [&] {
    throw std::invalid_argument(fmt::format(
        "{}:{}: a quotation mark stands where none may, or one is missing. Fix: save the table "
        "again as CSV from the spreadsheet.",
        name, line));
  };
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size() - 1) + 1;
    ++line;
    if (!parser.add_line(line, std::string(text.substr(start, end - start)))) refuse();
    start = end;
  }
  if (!parser.finish()) refuse();
  return parser.take_rows();
}

/// A spreadsheet's own file, or one in UTF-16, has bytes that no text in UTF-8 has.
void check_letters(const std::string& name, std::string_view text) {
  const auto is_no_letter = [](char letter) {
    constexpr char kFirstLetter = ' ', kDelete = 0x7F;
    return (letter >= 0 && letter < kFirstLetter && letter != '\t' && letter != '\r' &&
            letter != '\n') ||
           letter == kDelete;
  };
  const auto found = std::find_if(text.begin(), text.end(), is_no_letter);
  if (found == text.end()) return;
  throw std::invalid_argument(
      fmt::format("{}:{}: holds a byte that is no letter (number {}). Rule: a table is text in "
                  "UTF-8. Fix: save "
                  "it from the spreadsheet as CSV UTF-8.",
                  name, 1 + std::count(text.begin(), found, '\n'), static_cast<int>(*found)));
}

/// "1.012", "12.345.678": a number, or in a table with decimal commas perhaps a thousand times as
/// much.
bool may_have_thousands(std::string_view cell) {
  static const std::regex kGroups("[+-]?[1-9][0-9]{0,2}(\\.[0-9]{3})+");
  return std::regex_match(cell.begin(), cell.end(), kGroups);
}

/// The first row of these columns with a decimal comma in a number; null when there is none.
const TableRow* row_with_comma(const Table& table, std::span<const std::size_t> columns) {
  if (!table.has_decimal_comma) return nullptr;
  for (const TableRow& row : table.rows) {
    for (const std::size_t column : columns) {
      const std::string& cell = row.cells[column];
      if (cell.find(',') != std::string::npos && number_of(table, cell)) return &row;
    }
  }
  return nullptr;
}

/// What is wrong with a cell that must be a number, after its place; empty: nothing.
std::string problem_of(const std::string& cell, bool is_number, const TableRow* comma) {
  if (!is_number) {
    return fmt::format(
        "\"{}\", which is not a finite number. Fix: write a number, or delete the row.", cell);
  }
  if (comma != nullptr && may_have_thousands(cell)) {
    return fmt::format(
        "\"{}\", which may mean thousands: line {} has a decimal comma. Fix: write "
        "all numbers with a decimal comma and without points.",
        cell, comma->line);
  }
  return {};
}

void check_header(const Table& table, int line, base::ErrorList& errors) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& column = table.columns[i];
    if (column.empty()) {
      errors.add(fmt::format("{}:{}: column {} has no name. Fix: name it, or delete it.",
                             table.name, line, i + 1));
    } else if (!names.insert(column).second) {
      errors.add(fmt::format("{}:{}: two columns are called {}. Fix: rename one of them.",
                             table.name, line, column));
    }
  }
}

}  // namespace

std::optional<std::size_t> Table::column(std::string_view wanted) const {
  const auto found = std::find(columns.begin(), columns.end(), wanted);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

Table parse_table(const std::string& name, std::string_view text, NoRows no_rows) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  check_letters(name, text);
  const char delimiter = delimiter_of(text);
  std::vector<TableRow> rows = rows_of(name, text, delimiter);
  if (rows.empty()) {
    throw std::invalid_argument(
        name + ": is empty. Fix: give a table whose first line names the columns.");
  }
  Table table{
      .name = name,
      .columns = std::move(rows.front().cells),
      .rows = {std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end())},
      .has_decimal_comma = delimiter != ','};
  base::ErrorList errors;
  check_header(table, rows.front().line, errors);
  errors.require(no_rows == NoRows::allowed || !table.rows.empty(),
                 name + ": has no rows below its header. Fix: add a row for each reading or run.");
  base::ErrorList ragged(kMostRowErrors);
  for (const TableRow& row : table.rows) {
    if (row.cells.size() == table.columns.size()) continue;
    ragged.add(
        fmt::format("{}:{}: the row has {} cells, the header {}. Fix: give each row a cell "
                    "for each column.",
                    name, row.line, row.cells.size(), table.columns.size()));
  }
  errors.add(ragged);
  errors.throw_if_any();
  return table;
}

Table read_table(const std::filesystem::path& file, NoRows no_rows) {
  return parse_table(file.string(), base::read_whole_file(file), no_rows);
}

std::optional<double> number_of(const Table& table, std::string_view cell) {
  std::string text(cell);
  if (table.has_decimal_comma && text.find('.') == std::string::npos) {
    const std::size_t comma = text.find(',');
    if (comma != std::string::npos) text[comma] = '.';
  }
  const char* start = text.data() + (text.starts_with('+') && text.size() > 1 ? 1 : 0);
  const char* end = text.data() + text.size();
  double number = 0;
  const auto [stopped_at, error] = std::from_chars(start, end, number);
  if (error != std::errc{} || stopped_at != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::vector<std::vector<double>> numbers_of(const Table& table,
                                            std::span<const std::string> columns) {
  std::vector<std::size_t> places;
  base::ErrorList errors;
  for (const std::string& wanted : columns) {
    if (const auto column = table.column(wanted)) {
      places.push_back(*column);
      continue;
    }
    const std::string guess = base::closest_word(wanted, table.columns);
    errors.add(fmt::format("{}: has no column {}. {}Fix: it has {}.", table.name, wanted,
                           guess.empty() ? "" : fmt::format("Did you mean {}? ", guess),
                           fmt::join(table.columns, ", ")));
  }
  const TableRow* comma = row_with_comma(table, places);
  base::ErrorList cells(kMostRowErrors);
  std::vector<std::vector<double>> numbers(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const TableRow& row : table.rows) {
      const std::string& cell = row.cells[places[i]];
      const auto number = number_of(table, cell);
      const std::string problem = problem_of(cell, number.has_value(), comma);
      if (!problem.empty()) {
        cells.add(fmt::format("{}:{}: {} is {}", table.name, row.line, table.columns[places[i]],
                              problem));
      }
      numbers[i].push_back(number.value_or(0));
    }
  }
  errors.add(cells);
  errors.throw_if_any();
  return numbers;
}

}  // namespace repose::calibrate
