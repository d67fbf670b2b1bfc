#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/particles/particle_columns.h"
#include "calibrate/particles/text_scanner.h"
#include "calibrate/statistics/table/table.h"

/// Tables of particles: from spreadsheets, with columns separated by blanks, and EDEM's result
/// exports.
namespace repose::calibrate {
namespace {

using Cells = std::vector<std::string>;

constexpr char kBlanks = ' ';

Cells cells_of(std::string_view line, char delimiter) {
  Cells cells;
  if (delimiter == kBlanks) {
    TextScanner words(line);
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
      cells.emplace_back(word);
    }
    return cells;
  }
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(delimiter, from), line.size());
    std::string_view cell = line.substr(from, to - from);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"')) cell.remove_suffix(1);
    cells.emplace_back(cell);
    from = to + 1;
  }
  return cells;
}

char delimiter_in(std::string_view line) {
  for (const char delimiter : {';', '\t', ','}) {
    if (line.find(delimiter) != line.npos) return delimiter;
  }
  return kBlanks;
}

/// Comment marks of programs: "# x y z r", and YADE's "#format x_y_z_r".
std::string_view without_comment_mark(std::string_view line) {
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  const std::size_t from = line.find_first_not_of("#% ");
  return from == line.npos ? std::string_view() : line.substr(from);
}

/// "Q01 : Particle Position X:".
bool is_query(std::string_view cell) {
  constexpr std::size_t kShortest = 4;  // "Q01:"
  return cell.starts_with('Q') && without_query_number(cell).size() + kShortest <= cell.size();
}

struct Header {
  std::size_t behind = 0;  ///< where the next line begins
  int line = 0;
  std::string text;
  char delimiter = ',';
  bool is_edem = false;
};

/// Programs write titles, dates and settings above the columns' names.
std::optional<Header> header_of(std::string_view text) {
  constexpr int kDeepest = 200;  // lines
  TextScanner scanner(text);
  for (int line = 1; line <= kDeepest && !scanner.is_at_end(); ++line) {
    const std::string_view full = scanner.line();
    const std::string_view named = without_comment_mark(full);
    const char delimiter = delimiter_in(named);
    const Cells cells = cells_of(named, delimiter);
    const bool is_edem = is_query(named) || std::ranges::any_of(cells, is_query);
    if (!is_edem && !has_places(cells)) continue;
    return Header{.behind = scanner.at(),
                  .line = line,
                  .text = std::string(named),
                  .delimiter = is_edem && delimiter == kBlanks ? ',' : delimiter,
                  .is_edem = is_edem};
  }
  return std::nullopt;
}

[[noreturn]] void refuse_headless(const std::string& file, std::string_view text) {
  TextScanner scanner(text);
  std::string_view first = scanner.line();
  if (first.starts_with("\x1F\x8B")) {
    throw base::InputError({.where = file, .value = "is compressed", .fix = "unpack it: gunzip."});
  }
  constexpr std::size_t kShown = 60;
  first = first.substr(0, kShown);
  const bool is_text = std::ranges::none_of(
      first, [](char letter) { return letter >= 0 && letter < ' ' && letter != '\t'; });
  throw base::InputError(
      {.where = file,
       .value = text.find_first_not_of(" \r\n\t") == text.npos
                    ? "is empty"
                    : fmt::format("no line names columns x, y and z{}",
                                  is_text ? fmt::format("; it begins \"{}\"", first) : ""),
       .rule = "a table of particles has a header, such as x [mm],y [mm],z [mm],radius [mm]",
       .fix = "write one; or give a dump of LIGGGHTS or LAMMPS, or a file of VTK."});
}

/// A row of units below the header is moved into the column names.
void take_row_of_units(Table& table) {
  if (table.rows.empty()) return;
  const auto is_unit = [](const std::string& cell) {
    std::string_view unit = cell;
    if (unit.starts_with('[') || unit.starts_with('(')) unit = unit.substr(1, unit.size() - 2);
    return unit_named(unit).has_value();
  };
  const Cells& first = table.rows.front().cells;
  if (std::ranges::none_of(first, is_unit)) return;
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (is_unit(first[k])) {
      const bool is_bracketed = !first[k].empty() && (first[k][0] == '[' || first[k][0] == '(');
      table.columns[k] += is_bracketed ? ' ' + first[k] : fmt::format(" [{}]", first[k]);
    }
  }
  table.rows.erase(table.rows.begin());
}

ParticleColumns in_spreadsheet(const std::string& file, std::string_view text,
                               const Header& header) {
  // Lines above the header become empty, so that rows keep their line numbers.
  std::string cleaned(static_cast<std::size_t>(header.line - 1), '\n');
  cleaned += header.text;
  cleaned += '\n';
  cleaned += text.substr(header.behind);
  Table table = parse_table(file, cleaned);
  take_row_of_units(table);
  ParticleColumns found{.file = file, .format = "table", .columns = {}, .names = table.columns};
  std::vector<NumberColumn> wanted;
  for (const std::string& name : table.columns) {
    if (is_of_use(name)) wanted.push_back({.name = name});
  }
  std::vector<std::vector<double>> numbers = numbers_of(table, wanted);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    found.columns.push_back({.name = wanted[k].name, .values = std::move(numbers[k])});
  }
  std::vector<int> lines;
  lines.reserve(table.rows.size());
  for (const TableRow& row : table.rows) lines.push_back(row.line);
  found.place = [file, lines = std::move(lines)](std::size_t row) {
    return fmt::format("{}:{}", file, lines[row]);
  };
  return found;
}

/// Columns separated by any number of blanks.
ParticleColumns in_blanks(const std::string& file, std::string_view text, const Header& header) {
  ParticleColumns found{
      .file = file, .format = "table", .columns = {}, .names = cells_of(header.text, kBlanks)};
  std::vector<std::optional<std::size_t>> targets;
  for (const std::string& name : found.names) {
    targets.emplace_back();
    if (!is_of_use(name)) continue;
    targets.back() = found.columns.size();
    found.columns.push_back({.name = name, .values = {}});
  }
  base::Faults faults(kMaxRowErrors);
  std::vector<int> lines;
  TextScanner scanner(text);
  scanner.move_to(header.behind);
  for (int line = header.line + 1; !scanner.is_at_end(); ++line) {
    const std::string_view row = scanner.line();
    TextScanner words(row);
    std::string_view word = words.word();
    if (word.empty() || word.starts_with('#')) continue;
    lines.push_back(line);
    for (std::size_t k = 0; k < targets.size(); ++k, word = words.word()) {
      const auto value = targets[k] ? TextScanner::number(word) : std::optional(0.);
      if (word.empty() || !value) {
        faults.add({.where = fmt::format("{}:{}", file, line),
                    .subject = found.names[k],
                    .value = word.empty() ? "is missing"
                                          : fmt::format("is \"{}\", which is no number", word),
                    .fix = "write a number in each column, with a decimal point."});
        break;
      }
      if (targets[k]) found.columns[*targets[k]].values.push_back(*value);
    }
  }
  faults.throw_if_any();
  found.place = [file, lines = std::move(lines)](std::size_t row) {
    return fmt::format("{}:{}", file, lines[row]);
  };
  return found;
}

/// One time of an EDEM export.
struct EdemMoment {
  std::string time;
  int line = 0;
  std::vector<ParticleColumn> columns;
};

/// EDEM's text export (File > Export > Results Data): for each time a line "TIME:", and the
/// queries, "Q01 : Particle Position X:", each with its numbers after it in the same line, or below
/// it in a column. Source: Altair EDEM documentation, "Exporting Results Data".
class EdemReader {
 public:
  EdemReader(const std::string& file, char delimiter) : file_(file), delimiter_(delimiter) {}

  std::vector<EdemMoment> moments(std::string_view text) {
    TextScanner scanner(text);
    for (line_ = 1; !scanner.is_at_end(); ++line_) {
      Cells cells = cells_of(scanner.line(), delimiter_);
      std::erase_if(cells, [](const std::string& cell) { return cell.empty(); });
      if (!cells.empty()) take(cells);
    }
    faults_.throw_if_any();
    std::erase_if(moments_, [](const EdemMoment& one) { return one.columns.empty(); });
    for (const EdemMoment& one : moments_) check_lengths(one);
    return std::move(moments_);
  }

 private:
  void take(const Cells& cells) {
    if (cells.front().starts_with("TIME")) {
      moments_.push_back({.time = cells.size() > 1 ? cells[1] : "", .line = line_, .columns = {}});
      below_ = 0;
      return;
    }
    if (is_query(cells.front())) {
      if (moments_.empty()) moments_.push_back({.time = {}, .line = line_, .columns = {}});
      const bool is_row = cells.size() > 1 && !is_query(cells[1]);
      if (!is_row) begin_columns(cells);
      if (is_row) add_row(cells);
      return;
    }
    if (below_ > 0) add_below(cells);
  }

  void add_row(const Cells& cells) {
    below_ = 0;
    ParticleColumn column{.name = cells.front(), .values = {}};
    if (!is_of_use(column.name)) return;
    column.values.reserve(cells.size() - 1);
    for (std::size_t k = 1; k < cells.size(); ++k) column.values.push_back(number(cells[k]));
    moments_.back().columns.push_back(std::move(column));
  }

  void begin_columns(const Cells& cells) {
    std::vector<ParticleColumn>& columns = moments_.back().columns;
    first_ = columns.size();
    below_ = cells.size();
    for (const std::string& cell : cells) columns.push_back({.name = cell, .values = {}});
  }

  void add_below(const Cells& cells) {
    if (cells.size() != below_) {
      faults_.add({.where = fmt::format("{}:{}", file_, line_),
                   .value = fmt::format("the row has {} numbers, {} queries are above it",
                                        cells.size(), below_),
                   .fix = "export queries of particles alone, without averages and totals."});
      return;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      moments_.back().columns[first_ + k].values.push_back(number(cells[k]));
    }
  }

  double number(const std::string& cell) {
    std::string text = cell;
    if (delimiter_ != ',') std::ranges::replace(text, ',', '.');
    const auto value = TextScanner::number(text);
    if (!value) {
      faults_.add({.where = fmt::format("{}:{}", file_, line_),
                   .value = fmt::format("\"{}\" is no number", cell),
                   .fix = "export the queries again."});
    }
    return value.value_or(0);
  }

  void check_lengths(const EdemMoment& moment) const {
    for (const ParticleColumn& column : moment.columns) {
      const ParticleColumn& first = moment.columns.front();
      if (column.values.size() == first.values.size()) continue;
      throw base::InputError(
          {.where = fmt::format("{}:{}", file_, moment.line),
           .value = fmt::format("{} has {} numbers, {} has {}", without_query_number(first.name),
                                first.values.size(), without_query_number(column.name),
                                column.values.size()),
           .rule = "each query has one of each particle",
           .fix = "export all of them at once, of all particles; the file may be cut short."});
    }
  }

  const std::string& file_;
  char delimiter_;
  int line_ = 1;
  std::size_t first_ = 0;  ///< of the columns with numbers below them
  std::size_t below_ = 0;  ///< number of these; 0: none
  base::Faults faults_{kMaxRowErrors};
  std::vector<EdemMoment> moments_;
};

ParticleColumns in_edem(const std::string& file, std::string_view text, const Header& header,
                        const ParticleReading& reading) {
  std::vector<EdemMoment> moments = EdemReader(file, header.delimiter).moments(text);
  std::vector<std::string> labels;
  for (const EdemMoment& moment : moments) labels.push_back(moment.time);
  if (moments.empty()) refuse_headless(file, text);
  EdemMoment& chosen = moments[chosen_step(file, labels, reading)];
  ParticleColumns found{.file = file, .format = "EDEM export", .columns = {}, .names = {}};
  for (ParticleColumn& column : chosen.columns) {
    found.names.emplace_back(without_query_number(column.name));
    if (is_of_use(column.name)) found.columns.push_back(std::move(column));
  }
  found.step = chosen.time;
  found.steps = static_cast<int>(moments.size());
  return found;
}

}  // namespace

ParticleColumns columns_in_table(const std::string& file, std::string_view text,
                                 const ParticleReading& reading) {
  const auto header = header_of(text);
  // For binary spreadsheet files, parse_table() gives the right error.
  if (!header && (text.starts_with("PK") || text.starts_with("\xFF\xFE") ||
                  text.starts_with("\xFE\xFF") || text.starts_with("\xD0\xCF"))) {
    parse_table(file, text);
  }
  if (!header) refuse_headless(file, text);
  if (header->is_edem) return in_edem(file, text, *header, reading);
  return header->delimiter == kBlanks ? in_blanks(file, text, *header)
                                      : in_spreadsheet(file, text, *header);
}

}  // namespace repose::calibrate
