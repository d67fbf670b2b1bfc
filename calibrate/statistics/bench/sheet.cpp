#include "calibrate/statistics/bench/sheet.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace repose::calibrate {
namespace {

/// A row's readings, and those that hold for all rows; none if one is missing or no number.
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
    const auto number = column ? number_of(table, row.cells[*column]) : std::nullopt;
    if (!number) return std::nullopt;
    values.push_back(*number);
  }
  return values;
}

/// The columns that the table must have; those that it has and must not are errors.
std::vector<std::string> needed_columns(const Table& table,
                                        const std::map<std::string, double>& constants,
                                        const std::vector<std::string>& names,
                                        base::ErrorList& errors) {
  std::vector<std::string> needed;
  for (const std::string& name : names) {
    if (!constants.contains(name)) {
      needed.push_back(name);
    } else if (table.column(name)) {
      errors.add(
          fmt::format("{}: has a column {}, and --set gives it too. Fix: leave one of them out.",
                      table.name, name));
    }
  }
  return needed;
}

}  // namespace

BenchTest bench_test_named(std::string_view name) {
  const auto found = std::find(kBenchTestNames.begin(), kBenchTestNames.end(), name);
  if (found == kBenchTestNames.end()) {
    throw std::invalid_argument(fmt::format("bench test {}: unknown. Fix: choose {}.", name,
                                            fmt::join(kBenchTestNames, ", ")));
  }
  return static_cast<BenchTest>(found - kBenchTestNames.begin());
}

std::vector<std::string> column_names(BenchTest test) {
  std::vector<std::string> names;
  for (const ReadingColumn& column : columns_of(test)) names.push_back(column.name);
  return names;
}

std::vector<BenchReading> read_sheet(const std::filesystem::path& file, BenchTest test,
                                     const std::map<std::string, double>& constants, NoRows no_rows,
                                     base::ErrorList& errors) {
  const Table table = read_table(file, NoRows::allowed);
  const std::vector<std::string> names = column_names(test);
  if (table.rows.empty() && no_rows == NoRows::refused) {
    errors.add(
        fmt::format("{}: no readings yet: fill in a row for each reading below its header, {}.",
                    table.name, fmt::join(names, ", ")));
  }
  try {
    numbers_of(table, needed_columns(table, constants, names, errors));
  } catch (const std::invalid_argument& error) {
    errors.add(error.what());
  }
  std::vector<BenchReading> readings;
  const auto sample = table.column(kSampleColumn);
  for (const TableRow& row : table.rows) {
    auto values = values_in(table, row, constants, names);
    if (!values) continue;  // said above
    readings.push_back({.place = fmt::format("{}:{}", table.name, row.line),
                        .values = *std::move(values),
                        .sample = sample ? row.cells[*sample] : ""});
  }
  return readings;
}

}  // namespace repose::calibrate
