#include "calibrate/statistics/bench/sheet.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/statistics/table/other_rows.h"

namespace repose::calibrate {
namespace {

/// A row's readings, and those common to all rows; std::nullopt if one is missing or not a number.
std::optional<std::vector<double>> values_in(const Table& table, const TableRow& row,
                                             const std::map<std::string, double>& constants,
                                             const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names) {
    const auto constant = constants.find(name);
    if (constant != constants.end()) {
      values.push_back(constant->second);
      continue;
    }
    const auto column = table.column(name);
    const auto number = column ? number_of(row.cells[*column]) : std::nullopt;
    if (!number) return std::nullopt;
    values.push_back(*number);
  }
  return values;
}

/// The optional values that a row has, and those common to all rows.
std::map<std::string, double> optional_values_in(const Table& table, const TableRow& row,
                                                 const std::map<std::string, double>& constants,
                                                 const std::vector<std::string>& names) {
  std::map<std::string, double> values;
  for (const std::string& name : names) {
    const auto constant = constants.find(name);
    if (constant != constants.end()) values.insert(*constant);
    const auto column = table.column(name);
    const auto number = column ? number_of(row.cells[*column]) : std::nullopt;
    if (number) values.emplace(name, *number);
  }
  return values;
}

/// The columns that must hold numbers: those required, and optional ones present. Columns that must
/// not be present are errors.
std::vector<NumberColumn> needed_columns(const Table& table,
                                         const std::map<std::string, double>& constants,
                                         BenchTest test, base::Faults& errors) {
  for (const auto& [name, value] : constants) {
    if (!table.column(name)) continue;
    errors.add({.where = table.name,
                .value = fmt::format("has a column {}, and --set gives it too", name),
                .fix = "leave one of them out."});
  }
  std::vector<NumberColumn> needed;
  for (const auto& [name, what, above, below] : columns_of(test)) {
    if (!constants.contains(name)) needed.push_back({name, above, below});
  }
  for (const auto& [name, what, above, below] : optional_columns_of(test)) {
    if (table.column(name)) needed.push_back({name, above, below});
  }
  return needed;
}

std::vector<std::string> names_of(const std::vector<ReadingColumn>& columns) {
  std::vector<std::string> names;
  for (const ReadingColumn& column : columns) names.push_back(column.name);
  return names;
}

}  // namespace

std::vector<std::string> column_names(BenchTest test) { return names_of(columns_of(test)); }

std::vector<std::string> optional_column_names(BenchTest test) {
  return names_of(optional_columns_of(test));
}

std::string text_of(const LeftOut& left_out, const std::filesystem::path& file) {
  return fmt::format("{}: {} is left out ({}).", file.string(), left_out.what, left_out.why);
}

Sheet read_sheet(const std::filesystem::path& file, BenchTest test,
                 const std::map<std::string, double>& constants, NoRows no_rows,
                 base::Faults& errors) {
  return sheet_of(read_table(file, NoRows::allowed), test, constants, no_rows, errors);
}

Sheet sheet_of(Table table, BenchTest test, const std::map<std::string, double>& constants,
               NoRows no_rows, base::Faults& errors) {
  const std::vector<std::string> names = column_names(test);
  const std::vector<std::string> optional = optional_column_names(test);
  OtherRows other = take_other_rows(table, names, Unlabelled::refused, errors);
  Sheet sheet{
      .readings = {}, .left_out = std::move(other.left_out), .notes = std::move(other.notes)};
  for (const std::string& column : table.columns) {
    const bool is_used = column == kSampleColumn ||
                         std::ranges::find(names, column) != names.end() ||
                         std::ranges::find(optional, column) != optional.end();
    if (!is_used) sheet.left_out.push_back({"column " + column, "not a reading of this test"});
  }
  if (table.rows.empty() && no_rows == NoRows::refused) {
    errors.add({.where = table.name,
                .value = fmt::format(
                    "no readings yet: fill in a row for each reading below its header, {}.",
                    fmt::join(names, ", "))});
  }
  const std::vector<NumberColumn> needed = needed_columns(table, constants, test, errors);
  const std::set<int> unclear = unclear_lines(table, needed);
  try {
    numbers_of(table, needed);
  } catch (const base::InputError& error) {
    errors.add_all(error.faults());
  }
  const auto sample = table.column(kSampleColumn);
  for (const TableRow& row : table.rows) {
    auto values = values_in(table, row, constants, names);
    if (!values || unclear.contains(row.line)) continue;  // reported above
    sheet.readings.push_back({.place = fmt::format("{}:{}", table.name, row.line),
                              .values = *std::move(values),
                              .sample = sample ? row.cells[*sample] : "",
                              .optional = optional_values_in(table, row, constants, optional)});
  }
  return sheet;
}

}  // namespace repose::calibrate
