#include "calibrate/engine/engine_runs.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/fit/verification.h"
#include "calibrate/runs/table_columns.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRun = "run";
constexpr const char* kSeed = "seed";
constexpr const char* kStatus = "status";
constexpr const char* kReason = "reason";
constexpr const char* kDone = "ok";
constexpr const char* kFailed = "failed";
constexpr const char* kRowFile = "row.csv";

std::vector<std::string> usual_columns(const TableStudy& study) {
  std::vector<std::string> columns = {kRun};
  for (const Parameter& parameter : study.parameters) columns.push_back(parameter.name);
  for (const std::string& reading : readings_of(study)) columns.push_back(reading);
  columns.insert(columns.end(), {kSeed, kStatus, kReason});
  return columns;
}

/// Name prefix of runs of this purpose.
std::string_view prefix_of(RunsFor purpose) { return purpose == RunsFor::fit ? "run_" : "check_"; }

const char* file_of(RunsFor purpose) { return purpose == RunsFor::fit ? "runs.csv" : "checks.csv"; }

/// 12 for "run_012"; 0: not such a name.
int number_in(const std::string& name, RunsFor purpose) {
  const std::string_view prefix = prefix_of(purpose);
  if (!name.starts_with(prefix)) return 0;
  int number = 0;
  const char* end = name.data() + name.size();
  const auto [stopped_at, error] = std::from_chars(name.data() + prefix.size(), end, number);
  return error == std::errc{} && stopped_at == end ? number : 0;
}

/// Runs are numbered by the table: without it, new runs would overwrite these.
void refuse_runs_without_table(const fs::path& folder, const fs::path& file, RunsFor purpose) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& run = entry->path();
    const int number = number_in(run.filename().string(), purpose);
    if (number == 0 || !fs::exists(run / kReadingFile)) continue;
    base::refuse(
        file, "is not there, and folders of runs that were made are",
        fmt::format("put it back, or make it from the {} of each folder, or choose another "
                    "folder with --out.",
                    kRowFile));
  }
}

}  // namespace

EngineRuns::EngineRuns(const TableStudy& study, const fs::path& folder, RunsFor purpose)
    : study_(study),
      purpose_(purpose),
      folder_(folder / "runs"),
      file_(folder_ / file_of(purpose)) {
  const auto text = base::read_file_if_there(file_);
  table_.name = file_.string();
  if (!text) refuse_runs_without_table(folder_, file_, purpose);
  if (text) table_ = parse_table(file_.string(), *text, NoRows::allowed);
  const std::vector<std::string> usual = usual_columns(study);
  if (table_.columns.empty()) table_.columns = usual;
  std::vector<std::string> lacking;
  for (const std::string& column : usual) {
    if (table_.column(column)) continue;
    if (column == kRun || column == kSeed || column == kStatus || column == kReason) {
      add_column(column);
    } else {
      lacking.push_back(column);
    }
  }
  if (!lacking.empty()) {
    base::refuse(file_,
                 fmt::format("its runs were made for another study: they have no {}",
                             fmt::join(lacking, ", ")),
                 "another folder with --out.");
  }
  name_rows();
  refuse_other_parameters();
}

/// Refuses runs with parameters that the study no longer has: a fit would treat the effect of these
/// as random scatter.
void EngineRuns::refuse_other_parameters() const {
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    const auto text = base::read_file_if_there(folder_of(row) / kRunFile);
    if (!text) continue;
    const auto run = nlohmann::json::parse(*text, nullptr, false);
    if (!run.is_object() || !run.contains("parameters") || !run["parameters"].is_object()) continue;
    for (const auto& [name, value] : run["parameters"].items()) {
      if (std::ranges::find(study_.parameters, name, &Parameter::name) != study_.parameters.end()) {
        continue;
      }
      base::refuse(file_,
                   fmt::format("its runs were made for another study: they have a parameter {}, "
                               "which [parameter] has not",
                               name),
                   "another folder with --out; or put the parameter back.");
    }
  }
}

std::string& EngineRuns::cell(std::size_t row, const std::string& column) {
  return table_.rows[row].cells[*table_.column(column)];
}

const std::string& EngineRuns::cell(std::size_t row, const std::string& column) const {
  return table_.rows[row].cells[*table_.column(column)];
}

/// Inserts columns before the reason, in order of names, regardless of which run has one first.
void EngineRuns::add_column(const std::string& name) {
  const std::vector<std::string> usual = usual_columns(study_);
  std::size_t place = 0;
  for (std::size_t k = 0; k < table_.columns.size(); ++k) {
    const std::string& column = table_.columns[k];
    const bool is_usual = std::ranges::find(usual, column) != usual.end();
    if (column != kReason && (is_usual || column < name)) place = k + 1;
  }
  const auto at = static_cast<std::ptrdiff_t>(place);
  table_.columns.insert(table_.columns.begin() + at, name);
  for (TableRow& row : table_.rows) row.cells.insert(row.cells.begin() + at, std::string());
}

/// Names rows that a user has added.
void EngineRuns::name_rows() {
  int last = 0;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    last = std::max(last, number_in(cell(row, kRun), purpose_));
  }
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    std::string& name = cell(row, kRun);
    if (number_in(name, purpose_) > 0) continue;
    name = fmt::format("{}{:03}", prefix_of(purpose_), ++last);
  }
  const std::uint64_t before_first = purpose_ == RunsFor::fit ? 0 : kFirstCheckSeed;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    std::string& seed = cell(row, kSeed);
    const auto number = static_cast<std::uint64_t>(number_in(cell(row, kRun), purpose_));
    if (is_nothing(seed)) seed = fmt::format("{}", before_first + number);
  }
}

bool EngineRuns::has_reading(std::size_t row) const {
  return std::ranges::any_of(readings_of(study_), [&](const std::string& reading) {
    const std::string small = in_small_letters(cell(row, reading));
    return !is_nothing(small) && !says_failed(small);
  });
}

bool EngineRuns::is_made(std::size_t row) const {
  return !is_nothing(in_small_letters(cell(row, kStatus))) ||
         std::ranges::any_of(readings_of(study_), [&](const std::string& reading) {
           return !is_nothing(in_small_letters(cell(row, reading)));
         });
}

bool EngineRuns::is_within_bounds(std::size_t row) const {
  return std::ranges::all_of(study_.parameters, [&](const Parameter& parameter) {
    const auto value = number_of(cell(row, parameter.name));
    return value && *value >= parameter.min && *value <= parameter.max;
  });
}

std::vector<std::size_t> EngineRuns::to_make() const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    if (!is_made(row) && is_within_bounds(row)) rows.push_back(row);
  }
  return rows;
}

std::vector<std::size_t> EngineRuns::rows_at(const std::vector<double>& values) const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    if (run(row).values == values) rows.push_back(row);
  }
  return rows;
}

std::size_t EngineRuns::made() const {
  std::size_t count = 0;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) count += is_made(row) ? 1 : 0;
  return count;
}

std::size_t EngineRuns::failed() const {
  std::size_t count = 0;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    const bool says_so = says_failed(in_small_letters(cell(row, kStatus)));
    count += is_made(row) && (says_so || !has_reading(row)) ? 1 : 0;
  }
  return count;
}

bool EngineRuns::has_reading() const { return failed() < made(); }

void EngineRuns::retry_if_none_succeeded() {
  if (has_reading()) return;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    cell(row, kStatus).clear();
    for (const std::string& reading : readings_of(study_)) cell(row, reading).clear();
  }
}

void EngineRuns::plan(const TableRuns& table, const std::vector<NextRun>& runs) {
  TableRuns written = table;
  written.columns = table_.columns;
  written.delimiter = table_.delimiter;
  // As in existing numbers; if there are none, a decimal point.
  written.has_decimal_comma =
      table_.delimiter != ',' && std::ranges::any_of(table_.rows, [&](const TableRow& row) {
        return std::ranges::any_of(study_.parameters, [&](const Parameter& parameter) {
          return row.cells[*table_.column(parameter.name)].find(',') != std::string::npos;
        });
      });
  for (TableRow& row : next_runs_table(study_, written, runs).rows) {
    table_.rows.push_back(std::move(row));
  }
  name_rows();
  save();
}

EngineRun EngineRuns::run(std::size_t row) const {
  EngineRun run{.name = cell(row, kRun), .seed = 0, .values = {}};
  const std::string& seed = cell(row, kSeed);
  std::from_chars(seed.data(), seed.data() + seed.size(), run.seed);
  for (const Parameter& parameter : study_.parameters) {
    run.values.push_back(number_of(cell(row, parameter.name)).value_or(0));
  }
  return run;
}

fs::path EngineRuns::folder_of(std::size_t row) const { return folder_ / cell(row, kRun); }

/// Checks the row alone, in the run's folder, read like all rows.
std::string EngineRuns::fault_of(std::size_t row, const EngineOutcome& outcome) const {
  Table one{.name = {}, .columns = {}, .rows = {{}}, .has_decimal_comma = false};
  for (const Parameter& parameter : study_.parameters) {
    one.columns.push_back(parameter.name);
    one.rows.front().cells.push_back(
        fmt::format("{}", number_of(cell(row, parameter.name)).value_or(0)));
  }
  for (const EngineReading& reading : outcome.readings) {
    one.columns.push_back(reading.column);
    one.rows.front().cells.push_back(reading.cell);
  }
  for (const std::string& reading : readings_of(study_)) {
    if (one.column(reading)) continue;
    one.columns.push_back(reading);
    one.rows.front().cells.emplace_back();
  }
  const fs::path file = folder_of(row) / kRowFile;
  base::write_whole_file(file, csv_text(one));
  try {
    read_table_runs(study_, {file});
    return {};
  } catch (const base::InputError& error) {
    return error.what();
  }
}

std::string EngineRuns::keep(std::size_t row, EngineOutcome outcome) {
  if (outcome.failure.empty()) outcome.failure = fault_of(row, outcome);
  const std::vector<std::string> asked_for = readings_of(study_);
  const auto is_reading = [&](const EngineReading& one) {
    return std::ranges::find(asked_for, one.column) != asked_for.end() &&
           !says_failed(in_small_letters(one.cell));
  };
  if (outcome.failure.empty() && std::ranges::none_of(outcome.readings, is_reading)) {
    outcome.failure = "none of its readings is a number or a file";
  }
  const bool is_good = outcome.failure.empty();
  cell(row, kStatus) = is_good ? kDone : kFailed;
  if (is_good) {
    for (EngineReading& reading : outcome.readings) {
      if (!table_.column(reading.column)) add_column(reading.column);
      std::string& to = cell(row, reading.column);
      to = std::move(reading.cell);
      if (reading.is_file) {
        to = cell(row, kRun) + '/' + to;
      } else if (table_.delimiter != ',') {
        // As a spreadsheet saved it.
        const std::string& beside = cell(row, study_.parameters.front().name);
        if (beside.find(',') != std::string::npos) std::ranges::replace(to, '.', ',');
      }
    }
  }
  save();
  return outcome.failure;
}

void EngineRuns::save() const { base::write_whole_file(file_, csv_text(table_)); }

}  // namespace repose::calibrate
