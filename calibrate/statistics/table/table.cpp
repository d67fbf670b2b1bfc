#include "calibrate/statistics/table/table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <regex>
#include <set>
#include <utility>

#include <csv.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"

namespace repose::calibrate {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// libcsv's parser, fed line by line so that the line of each row is known.
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

  /// False if the text breaks the quoting rules.
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

/// The line of a text at `start`, without its end.
std::string_view line_at(std::string_view text, std::size_t start) {
  std::string_view line = text.substr(start, text.find('\n', start) - start);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// The delimiter declared to spreadsheets in a line of its own above the header.
std::optional<char> told_delimiter(std::string_view text) {
  static const std::regex kLine("\"?sep=(;|,|\\t|\\|)\"?[;,\t ]*", std::regex::icase);
  const std::string first(line_at(text, 0));
  std::smatch found;
  if (!std::regex_match(first, found, kLine)) return std::nullopt;
  return found[1].str().front();
}

constexpr char kNoDelimiter = '\0';

char delimiter_of(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \r\n");
  if (start == std::string_view::npos) return kNoDelimiter;
  const std::string_view header = line_at(text, start);
  for (const char delimiter : {';', '\t', ','}) {
    if (header.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return kNoDelimiter;
}

/// @param lines_before  lines of the file before the text
std::vector<TableRow> rows_of(const std::string& name, std::string_view text, char delimiter,
                              int lines_before) {
  Parser parser(delimiter);
  int line = lines_before;
  const auto refuse = [&] {
    throw base::InputError({.where = fmt::format("{}:{}", name, line),
                            .value = "a quotation mark stands where none may, or one is missing",
                            .fix = "save the table again as CSV from the spreadsheet."});
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

/// Rejects files that are not text, by their first bytes.
void check_kind(const std::string& name, std::string_view text) {
  struct Kind {
    std::string_view start;
    const char* what;
  };
  constexpr std::array<Kind, 5> kKinds = {{
      {"PK\x03\x04", "a spreadsheet's own file (.xlsx or .ods)"},
      {"\xD0\xCF\x11\xE0", "a spreadsheet's own file (.xls)"},
      {"%PDF", "a PDF"},
      {"\xFF\xFE", "text in UTF-16"},
      {"\xFE\xFF", "text in UTF-16"},
  }};
  for (const auto& [start, what] : kKinds) {
    if (!text.starts_with(start)) continue;
    throw base::InputError({.where = name,
                            .value = fmt::format("is {}", what),
                            .rule = "a table is text in UTF-8",
                            .fix = "save it from the spreadsheet as CSV UTF-8."});
  }
}

void check_letters(const std::string& name, std::string_view text) {
  const auto is_no_letter = [](char letter) {
    constexpr char kFirstLetter = ' ', kDelete = 0x7F;
    return (letter >= 0 && letter < kFirstLetter && letter != '\t' && letter != '\r' &&
            letter != '\n') ||
           letter == kDelete;
  };
  const auto found = std::find_if(text.begin(), text.end(), is_no_letter);
  if (found == text.end()) return;
  throw base::InputError(
      {.where = fmt::format("{}:{}", name, 1 + std::count(text.begin(), found, '\n')),
       .value = fmt::format("holds a byte that is no letter (number {})", static_cast<int>(*found)),
       .rule = "a table is text in UTF-8",
       .fix = "save it from the spreadsheet as CSV UTF-8."});
}

bool is_empty(const TableRow& row) {
  return std::all_of(row.cells.begin(), row.cells.end(),
                     [](const std::string& cell) { return cell.empty(); });
}

/// Spreadsheets write separators as far as a sheet was ever filled in.
void drop_what_is_empty(std::vector<TableRow>& rows) {
  std::erase_if(rows, is_empty);
  if (rows.empty()) return;
  std::size_t columns = 0;
  for (const TableRow& row : rows) {
    for (std::size_t k = columns; k < row.cells.size(); ++k) {
      if (!row.cells[k].empty()) columns = k + 1;
    }
  }
  for (TableRow& row : rows) {
    const bool is_header = &row == &rows.front();
    const std::size_t wanted = is_header ? columns : rows.front().cells.size();
    if (row.cells.size() > wanted &&
        std::all_of(row.cells.begin() + static_cast<std::ptrdiff_t>(wanted), row.cells.end(),
                    [](const std::string& cell) { return cell.empty(); })) {
      row.cells.resize(wanted);
    }
  }
}

/// In a table of one column, "1,22" under "2,23" may be a number with its row number: "3,25".
void check_single_column(const Table& table) {
  constexpr std::size_t kFewest = 2;
  if (table.rows.size() < kFewest) return;
  for (const int first : {0, 1}) {
    int next = first;
    const bool counts = std::all_of(table.rows.begin(), table.rows.end(), [&](const TableRow& row) {
      return row.cells.size() == 1 && row.cells.front().starts_with(fmt::format("{},", next++));
    });
    if (!counts) continue;
    throw base::InputError(
        {.where = fmt::format("{}:{}", table.name, table.rows.front().line),
         .value = fmt::format(
             "the header names one column, and \"{}\" may be a row's number and a reading",
             table.rows.front().cells.front()),
         .fix = fmt::format("name both columns, as in row,{}; or write decimal points.",
                            table.columns.front())});
  }
}

std::optional<double> without(std::string_view cell, char mark) {
  std::string digits(cell);
  std::erase(digits, mark);
  return number_of(digits);
}

/// The meaning of points and commas in the numbers of a table, as far as it can be determined.
class NumberMarks {
 public:
  NumberMarks(const Table& table, std::span<const std::size_t> columns) : table_(table) {
    for (const TableRow& row : table.rows) {
      for (const std::size_t column : columns) {
        const std::string& cell = row.cells[column];
        if (!number_of(cell)) continue;
        for (const char mark : {'.', ','}) {
          if (cell.find(mark) == std::string::npos) continue;
          if (mark == ',' && table.has_decimal_comma && comma_row_ == nullptr) comma_row_ = &row;
          if (may_have_thousands(cell, mark)) continue;
          if (mark == '.') has_decimal_point_ = true;
          if (mark == ',' && comma_row_ == nullptr) comma_row_ = &row;
        }
      }
    }
  }

  /// Error of a cell that must be a number.
  std::optional<base::Fault> problem_of(const std::string& cell, const NumberColumn& column) const {
    const bool has_comma = cell.find(',') != std::string::npos;
    const bool has_point = cell.find('.') != std::string::npos;
    const auto value = number_of(cell);
    if (!value && has_comma && has_point) {
      return base::Fault{
          .value = fmt::format("is \"{}\", which has points and commas", cell),
          .fix = "write it with a decimal point, and without signs between thousands."};
    }
    const char mark = has_comma ? ',' : '.';
    const bool is_ambiguous = may_have_thousands(cell, mark);
    if (!value && (!is_ambiguous || is_settled(mark))) {
      return base::Fault{.value = fmt::format("is \"{}\", which is not a finite number", cell),
                         .fix = "write a number, or delete the row."};
    }
    if (!is_ambiguous || is_settled(mark)) return std::nullopt;
    // A sheet with decimal commas has no decimal points, however plausible the number would be.
    if (comma_row_ != nullptr && mark == '.') {
      return base::Fault{
          .value = fmt::format("is \"{}\", which may mean thousands: line {} has a decimal comma",
                               cell, comma_row_->line),
          .fix = "write all numbers with a decimal comma and without points."};
    }
    const auto is_possible = [&](double number) {
      return number > column.above && number < column.below;
    };
    const double thousands = without(cell, mark).value_or(0);
    if (value && is_possible(*value) && !is_possible(thousands)) return std::nullopt;
    return base::Fault{
        .value = fmt::format(
            "is \"{}\", which may mean {:.10g}{}", cell, thousands,
            value && is_possible(*value) ? fmt::format(" as well as {:.10g}", *value) : ""),
        .fix = fmt::format(
            "write {:.10g} if it does{}.", thousands,
            value ? fmt::format(", otherwise {:.10g} with a 0 behind it, as in {}0", *value, cell)
                  : "")};
  }

 private:
  bool is_settled(char mark) const {
    if (mark == ',') return table_.has_decimal_comma || comma_row_ != nullptr;
    return comma_row_ == nullptr && (!table_.has_decimal_comma || has_decimal_point_);
  }

  const Table& table_;
  const TableRow* comma_row_ = nullptr;  ///< the first with a decimal comma
  bool has_decimal_point_ = false;
};

/// Whether they are whole numbers, each once; words are labels of rows that are not readings.
bool numbers_rows(const Table& table, std::size_t place) {
  std::set<double> numbers;
  for (const TableRow& row : table.rows) {
    if (row.cells.size() <= place) return false;
    const auto number = number_of(row.cells[place]);
    if (!number) continue;
    const bool is_whole = *number >= 0 && *number == std::floor(*number);
    if (!is_whole || !numbers.insert(*number).second) return false;
  }
  return !numbers.empty();
}

void name_row_numbers(Table& table) {
  constexpr const char* kRow = "row";
  if (table.columns.size() < 2 || !table.columns.front().empty() || table.column(kRow)) return;
  if (!numbers_rows(table, 0)) return;
  table.columns.front() = kRow;
  table.has_unnamed_row_numbers = true;
}

void check_header(const Table& table, int line, base::Faults& errors) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& column = table.columns[i];
    if (column.empty()) {
      errors.add({.where = fmt::format("{}:{}", table.name, line),
                  .value = fmt::format("column {} has no name", i + 1),
                  .fix = "name it, or delete it."});
    } else if (!names.insert(column).second) {
      errors.add({.where = fmt::format("{}:{}", table.name, line),
                  .value = fmt::format("two columns are called {}", column),
                  .fix = "rename one of them."});
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
  check_kind(name, text);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  check_letters(name, text);
  const std::optional<char> told = told_delimiter(text);
  if (told) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  const char delimiter = told.value_or(delimiter_of(text));
  std::vector<TableRow> rows =
      rows_of(name, text, delimiter == kNoDelimiter ? ';' : delimiter, told ? 1 : 0);
  drop_what_is_empty(rows);
  if (rows.empty()) {
    throw base::InputError({.where = name,
                            .value = "is empty",
                            .fix = "give a table whose first line names the columns."});
  }
  Table table{
      .name = name,
      .columns = std::move(rows.front().cells),
      .rows = {std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end())},
      .has_decimal_comma = delimiter != ',',
      .delimiter = delimiter == kNoDelimiter ? ';' : delimiter};
  name_row_numbers(table);
  base::Faults errors;
  check_header(table, rows.front().line, errors);
  errors.require(no_rows == NoRows::allowed || !table.rows.empty(),
                 {.where = name,
                  .value = "has no rows below its header",
                  .fix = "add a row for each reading or run."});
  base::Faults ragged(kMaxRowErrors);
  for (const TableRow& row : table.rows) {
    if (row.cells.size() == table.columns.size()) continue;
    ragged.add({.where = fmt::format("{}:{}", name, row.line),
                .value = fmt::format("the row has {} cells, the header {}", row.cells.size(),
                                     table.columns.size()),
                .fix = "give each row a cell for each column."});
  }
  errors.add_all(ragged.all());
  errors.throw_if_any();
  if (delimiter == kNoDelimiter) check_single_column(table);
  return table;
}

Table read_table(const std::filesystem::path& file, NoRows no_rows) {
  return parse_table(file.string(), base::read_whole_file(file), no_rows);
}

std::string csv_text(const Table& table) {
  // Unusual delimiters are declared in a line of their own.
  const char delimiter = table.delimiter == '|' ? ';' : table.delimiter;
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (const std::string& cell : cells) {
      if (&cell != &cells.front()) text += delimiter;
      const bool is_plain = cell.find_first_of(",;\t\"\r\n") == std::string::npos;
      const bool is_decimal_comma =
          cell.find(delimiter) == std::string::npos && number_of(cell).has_value();
      if (is_plain || is_decimal_comma) {
        text += cell;
        continue;
      }
      text += '"';
      for (const char letter : cell) text.append(letter == '"' ? 2 : 1, letter);
      text += '"';
    }
    return text + '\n';
  };
  std::string text = line(table.columns);
  for (const TableRow& row : table.rows) text += line(row.cells);
  return text;
}

std::optional<double> number_of(std::string_view cell) {
  std::string text(cell);
  if (text.find('.') == std::string::npos) {
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

bool may_have_thousands(std::string_view cell, char mark) {
  // Most cells end differently, and a regex is slow in a table of a million.
  constexpr std::size_t kEnd = 4;  // ".012"
  const std::size_t last = cell.rfind(mark);
  if (last == cell.npos || last + kEnd != cell.size()) return false;
  static const std::regex kPoints("[+-]?[1-9][0-9]{0,2}(\\.[0-9]{3})+");
  static const std::regex kCommas("[+-]?[1-9][0-9]{0,2}(,[0-9]{3})+");
  return std::regex_match(cell.begin(), cell.end(), mark == '.' ? kPoints : kCommas);
}

std::set<int> unclear_lines(const Table& table, std::span<const NumberColumn> columns) {
  std::vector<NumberColumn> found;
  std::vector<std::size_t> places;
  for (const NumberColumn& wanted : columns) {
    const auto column = table.column(wanted.name);
    if (!column) continue;
    found.push_back(wanted);
    places.push_back(*column);
  }
  const NumberMarks marks(table, places);
  std::set<int> lines;
  for (const TableRow& row : table.rows) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (marks.problem_of(row.cells[places[i]], found[i])) lines.insert(row.line);
    }
  }
  return lines;
}

std::vector<std::vector<double>> numbers_of(const Table& table,
                                            std::span<const NumberColumn> columns) {
  std::vector<NumberColumn> found;
  std::vector<std::size_t> places;
  base::Faults errors;
  for (const NumberColumn& wanted : columns) {
    if (const auto column = table.column(wanted.name)) {
      found.push_back(wanted);
      places.push_back(*column);
      continue;
    }
    const std::string guess = base::closest_word(wanted.name, table.columns);
    const bool is_in_other_unit =
        guess.substr(0, guess.rfind('_')) == wanted.name.substr(0, wanted.name.rfind('_'));
    if (is_in_other_unit) {
      errors.add({.where = table.name,
                  .value = fmt::format("has {}, not {}", guess, wanted.name),
                  .fix = fmt::format("name it {}, with its numbers in that unit.", wanted.name)});
      continue;
    }
    errors.add({.where = table.name,
                .value = fmt::format("has no column {}{}", wanted.name,
                                     guess.empty() ? "" : fmt::format(". Did you mean {}?", guess)),
                .fix = fmt::format("it has {}.", fmt::join(table.columns, ", "))});
  }
  const NumberMarks marks(table, places);
  base::Faults cells(kMaxRowErrors);
  std::vector<std::vector<double>> numbers(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const TableRow& row : table.rows) {
      const std::string& cell = row.cells[places[i]];
      if (auto fault = marks.problem_of(cell, found[i])) {
        fault->where = fmt::format("{}:{}", table.name, row.line);
        fault->subject = found[i].name;
        cells.add(*std::move(fault));
      }
      numbers[i].push_back(number_of(cell).value_or(0));
    }
  }
  errors.add_all(cells.all());
  errors.throw_if_any();
  return numbers;
}

}  // namespace repose::calibrate
