#include "calibrate/runs/table_runs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/runs/pictured_cells.h"
#include "calibrate/runs/table_columns.h"
#include "calibrate/statistics/table/other_rows.h"

namespace repose::calibrate {
namespace {

using Names = std::vector<std::string>;

/// A row, as far as it is numbers.
struct Row {
  int line = 0;
  std::string where;                                   ///< "runs.csv:14"
  std::vector<double> values;                          ///< of the parameters
  std::map<std::string, std::optional<double>> reads;  ///< none: empty, or the run failed
  std::map<std::string, double> sds;
  std::map<std::string, double> own_sds;  ///< of readings measured in pictures
  std::optional<std::uint64_t> seed;
  int repeats = 1;
  std::string failure;                          ///< of all readings
  std::map<std::string, std::string> failures;  ///< of one
};

/// The rows of one table.
class RowReader {
 public:
  RowReader(const TableStudy& study, Table table, base::Faults& faults)
      : study_(study),
        table_(std::move(table)),
        columns_(columns_of(study, table_, faults)),
        faults_(faults) {}

  const TableColumns& columns() const { return columns_; }

  std::vector<Row> rows() {
    std::vector<Row> rows(table_.rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].line = table_.rows[k].line;
      rows[k].where = fmt::format("{}:{}", table_.name, rows[k].line);
    }
    if (!faults_.empty()) return rows;
    read_numbers(rows);
    for (std::size_t k = 0; k < rows.size(); ++k) read_words(table_.rows[k], rows[k]);
    return rows;
  }

  Names unknown_words() const { return {unknown_.begin(), unknown_.end()}; }

 private:
  const std::string& cell(const TableRow& row, const std::string& column) const {
    return row.cells[*table_.column(column)];
  }

  base::Fault fault_at(int line, const std::string& column, std::string value, std::string fix) {
    return {.where = fmt::format("{}:{}", table_.name, line),
            .subject = column,
            .value = std::move(value),
            .fix = std::move(fix)};
  }

  /// Numbers of a column that a row may lack: those that are words are left as 0, and passed over.
  Names sparse_columns() const {
    Names names = columns_.readings;
    for (const auto& [reading, column] : columns_.sd) names.push_back(column);
    for (const auto& column : {columns_.count, columns_.seed}) {
      if (column) names.push_back(*column);
    }
    return names;
  }

  void read_numbers(std::vector<Row>& rows) {
    // What a point or a comma means is told by all numbers together.
    Table numbers = table_;
    std::vector<NumberColumn> wanted;
    for (const Parameter& parameter : study_.parameters) {
      const double width = parameter.max - parameter.min;
      wanted.push_back(
          {.name = parameter.name, .above = parameter.min - width, .below = parameter.max + width});
    }
    const Names sparse = sparse_columns();
    for (const std::string& name : sparse) {
      wanted.push_back({.name = name});
      const std::size_t place = *table_.column(name);
      for (TableRow& row : numbers.rows) {
        const std::string small = in_small_letters(row.cells[place]);
        if (is_nothing(small) || says_failed(small)) row.cells[place].assign(1, '0');
      }
    }
    std::vector<std::vector<double>> all;
    try {
      all = numbers_of(numbers, wanted);
    } catch (const base::InputError& error) {
      faults_.add_all(error.faults());
      return;
    }
    const auto number = [&](const std::string& column, std::size_t row) -> std::optional<double> {
      const std::string small = in_small_letters(cell(table_.rows[row], column));
      if (is_nothing(small) || says_failed(small)) return std::nullopt;
      const auto found = std::ranges::find(wanted, column, &NumberColumn::name);
      return all[static_cast<std::size_t>(found - wanted.begin())][row];
    };
    base::Faults cells(kMaxRowErrors);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Row& row = rows[k];
      for (std::size_t j = 0; j < columns_.parameters.size(); ++j) row.values.push_back(all[j][k]);
      for (const std::string& reading : columns_.readings) {
        row.reads[reading] = number(reading, k);
        if (row.reads[reading] && std::abs(*row.reads[reading]) > kMaxReading) {
          cells.add(fault_at(row.line, reading, fmt::format("is {:g}", *row.reads[reading]),
                             "NaN where the run failed, or another unit."));
        }
        check_range(row, reading, cells);
      }
      read_repeats(row, k, number, cells);
    }
    faults_.add_all(cells.all());
  }

  /// An angle of 9999 degrees is a failed run's.
  void check_range(const Row& row, const std::string& reading, base::Faults& cells) {
    const auto value = row.reads.at(reading);
    for (const auto* observables : {&study_.measured, &study_.held_out}) {
      for (const Observable& one : *observables) {
        if (!value || one.name != reading) continue;
        if (*value >= one.least && *value <= one.most) continue;
        cells.add(fault_at(row.line, reading,
                           fmt::format("is {:g}: in {}, readings are from {:g} to {:g}", *value,
                                       one.unit, one.least, one.most),
                           "NaN where the run failed, or another unit."));
      }
    }
  }

  template <typename Number>
  void read_repeats(Row& row, std::size_t k, const Number& number, base::Faults& cells) {
    const auto is_whole = [](double value) { return value >= 0 && value == std::floor(value); };
    constexpr double kMostRepeats = 1e6, kMostSeed = 9007199254740992.;  // whole in a double
    if (columns_.count) {
      const auto count = number(*columns_.count, k);
      if (count && (!is_whole(*count) || *count > kMostRepeats)) {
        cells.add(fault_at(row.line, *columns_.count, fmt::format("is {:g}", *count),
                           "the number of runs that the row is the mean of."));
      } else if (count) {
        row.repeats = static_cast<int>(*count);
      }
    }
    if (columns_.seed) {
      const auto seed = number(*columns_.seed, k);
      if (seed && (!is_whole(*seed) || *seed > kMostSeed)) {
        cells.add(fault_at(row.line, *columns_.seed, fmt::format("is {:g}", *seed),
                           "a whole number from 0 on, or leave it empty."));
      } else if (seed) {
        row.seed = static_cast<std::uint64_t>(*seed);
      }
    }
    for (const auto& [reading, column] : columns_.sd) {
      const auto sd = number(column, k);
      if (sd && *sd < 0) {
        cells.add(fault_at(row.line, column, fmt::format("is {:g}", *sd),
                           "a standard deviation is 0 or more."));
      } else if (sd && row.repeats > 1) {
        row.sds[reading] = *sd;
      }
    }
  }

  void read_words(const TableRow& cells, Row& row) {
    if (columns_.status) {
      const std::string& status = cell(cells, *columns_.status);
      const std::string small = in_small_letters(status);
      if (says_failed(small) || small == "no" || small == "false") {
        row.failure = fmt::format("{} is {}", *columns_.status, status);
      } else if (!says_done(small) && !is_nothing(small)) {
        unknown_.insert(status);
      }
    }
    if (columns_.count && row.repeats == 0) {
      row.failure = fmt::format("{} is 0", *columns_.count);
      row.repeats = 1;
    }
    for (const std::string& reading : columns_.readings) {
      const std::string& word = cell(cells, reading);
      if (says_failed(in_small_letters(word))) {
        row.failures[reading] = fmt::format("{} is {}", reading, word);
      }
    }
  }

  const TableStudy& study_;
  Table table_;
  TableColumns columns_;
  base::Faults& faults_;
  std::set<std::string> unknown_;
};

/// Puts the rows of all tables together.
class Collector {
 public:
  explicit Collector(const TableStudy& study) : study_(study), readings_(readings_of(study)) {}

  void add(const std::string& file, const TableColumns& columns, std::vector<Row> rows) {
    for (std::size_t k = columns.measured; k < columns.readings.size(); ++k) {
      if (std::ranges::find(others_, columns.readings[k]) == others_.end()) {
        others_.push_back(columns.readings[k]);
      }
    }
    int outside = 0;
    std::string first;
    for (Row& row : rows) {
      if (const std::string why = outside_of(row); !why.empty()) {
        if (outside++ == 0) first = fmt::format("line {}: {}", row.line, why);
        continue;
      }
      all_.push_back(std::move(row));
    }
    found_.left_out += outside;
    if (outside == 0) return;
    found_.notes.push_back(fmt::format(
        "{}: {} of {} rows are outside the bounds of [parameter] and not used ({}). To use them, "
        "widen the bounds.",
        file, outside, rows.size(), first));
  }

  TableRuns take() {
    number_repeats();
    found_.rows = static_cast<int>(all_.size());
    for (const Row& row : all_) {
      found_.places.push_back(row.values);
      add_runs(row);
    }
    for (const std::string& other : others_) add_offer(other);
    count_failures();
    return std::move(found_);
  }

 private:
  std::string outside_of(const Row& row) const {
    for (std::size_t j = 0; j < row.values.size(); ++j) {
      const Parameter& parameter = study_.parameters[j];
      if (row.values[j] >= parameter.min && row.values[j] <= parameter.max) continue;
      return fmt::format("{} is {:g}, the bounds are {:g} and {:g}", parameter.name, row.values[j],
                         parameter.min, parameter.max);
    }
    return {};
  }

  /// A run that is still to be made.
  static bool says_nothing(const Row& row) {
    return row.failure.empty() && row.failures.empty() &&
           std::ranges::none_of(row.reads, [](const auto& one) { return one.second.has_value(); });
  }

  static bool is_copy(const Row& one, const Row& other) {
    return one.reads == other.reads && one.failure == other.failure &&
           one.failures == other.failures;
  }

  /// What rows at one place tell.
  struct Repeats {
    std::set<std::size_t> copies;  ///< the same numbers once more
    bool differ = false;           ///< chance has a part in some
    int same_seed = 0;             ///< and other readings
  };

  void compare(const std::vector<std::size_t>& rows, std::size_t i, Repeats& repeats) const {
    bool is_one = false, is_first = true;
    for (std::size_t j = 0; j < i; ++j) {
      const Row &row = all_[rows[i]], &before = all_[rows[j]];
      if (says_nothing(row) || says_nothing(before)) continue;
      is_first = false;
      is_one = is_one || is_copy(row, before);
      if (!is_copy(row, before) && row.seed && row.seed == before.seed) ++repeats.same_seed;
    }
    if (is_one) {
      repeats.copies.insert(rows[i]);
    } else if (!is_first) {
      repeats.differ = true;
    }
  }

  /// Rows at one place are runs with other seeds. The same numbers once more are a copy where
  /// chance has a part in others; where it has none, they are what a run repeated gives.
  void number_repeats() {
    std::map<std::vector<double>, std::vector<std::size_t>> by_place;
    for (std::size_t k = 0; k < all_.size(); ++k) by_place[all_[k].values].push_back(k);
    Repeats repeats;
    // Repeats that a row is the mean of tell it, too.
    repeats.differ = std::ranges::any_of(all_, [](const Row& row) {
      return std::ranges::any_of(row.sds, [](const auto& one) { return one.second > 0; });
    });
    for (const auto& [place, rows] : by_place) {
      for (std::size_t i = 1; i < rows.size(); ++i) compare(rows, i, repeats);
      give_seeds(rows);
    }
    if (repeats.same_seed > 0) {
      found_.notes.push_back(fmt::format(
          "{} have the parameters and the seed of another one and other readings: they count as "
          "runs with other seeds.",
          rows_text(repeats.same_seed)));
    }
    if (!repeats.copies.empty()) leave_out(repeats);
  }

  void leave_out(const Repeats& repeats) {
    const std::string copies = rows_text(static_cast<int>(repeats.copies.size()));
    if (!repeats.differ) {
      found_.notes.push_back(fmt::format(
          "Alike to the last digit with another one at the same parameters: {}, and no repeat "
          "differs, as of a program without chance. If they are copies, delete them.",
          copies));
      return;
    }
    std::vector<Row> kept;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (!repeats.copies.contains(k)) kept.push_back(std::move(all_[k]));
    }
    all_ = std::move(kept);
    found_.left_out += static_cast<int>(repeats.copies.size());
    found_.notes.push_back(fmt::format(
        "Copies of another row, where runs with other seeds differ: {}. Each counts once.",
        copies));
  }

  static std::string rows_text(int rows) {
    return rows == 1 ? "1 row" : fmt::format("{} rows", rows);
  }

  void give_seeds(const std::vector<std::size_t>& rows) {
    std::set<std::uint64_t> used;
    for (const std::size_t row : rows) {
      if (all_[row].seed && !used.insert(*all_[row].seed).second) all_[row].seed.reset();
    }
    std::uint64_t next = 1;
    for (const std::size_t row : rows) {
      if (all_[row].seed) continue;
      while (!used.insert(next).second) ++next;
      all_[row].seed = next;
    }
  }

  static std::optional<Run> run_of(const Row& row, const std::string& reading) {
    Run run;
    run.job = {.experiment = reading, .values = row.values, .seed = row.seed.value_or(1)};
    run.failure = row.failure;
    if (const auto own = row.failures.find(reading); own != row.failures.end()) {
      run.failure = own->second;
    }
    if (!run.failure.empty()) return run;
    const auto value = row.reads.find(reading);
    if (value == row.reads.end() || !value->second) return std::nullopt;
    run.readings["value"] = *value->second;
    if (const auto own = row.own_sds.find(reading); own != row.own_sds.end()) {
      run.reading_sd["value"] = own->second;  // of one run, whatever other readings are means of
      return run;
    }
    run.repeats = row.repeats;
    if (const auto sd = row.sds.find(reading); sd != row.sds.end()) {
      run.repeat_sd["value"] = sd->second;
    }
    return run;
  }

  void add_runs(const Row& row) {
    bool has_any = false, has_failed = false;
    for (const std::string& reading : readings_) {
      const auto run = run_of(row, reading);
      if (!run) continue;
      if (!run->failure.empty()) {
        has_failed = true;
        if (why_.empty()) why_ = run->failure;
        continue;
      }
      has_any = true;
      found_.runs.push_back(*run);
      found_.run_rows.push_back(row.where);
    }
    if (has_failed) ++found_.failed;
    if (!has_any && !has_failed) ++found_.without_reading;
  }

  void add_offer(const std::string& other) {
    Offer offer{
        .experiment = {.name = other, .parameters = {}},
        .study_lines = fmt::format("[measured]\n\"{0}\" = {{ readings = \"{0}.csv\" }}\n", other),
        .runs = {},
        .heading = fmt::format("{}, a column of the table,", other)};
    for (std::size_t j = 0; j < study_.parameters.size(); ++j) {
      offer.experiment.parameters.push_back(j);
    }
    for (const Row& row : all_) {
      const auto run = run_of(row, other);
      if (run && run->failure.empty()) offer.runs.push_back(*run);
    }
    std::ranges::stable_sort(offer.runs, {}, [](const Run& run) { return run.job.values; });
    found_.others.push_back(std::move(offer));
  }

  void count_failures() {
    if (found_.failed > 0) {
      found_.notes.push_back(fmt::format(
          "Failed runs: {} of {} rows (the first: {}). They are left out: whether the parameters "
          "or the computer made them fail, the table does not say.",
          found_.failed, found_.rows, why_));
    }
    if (found_.without_reading > 0) {
      found_.notes.push_back(fmt::format(
          "No reading: {} of {} rows, which say nothing. Where such a run failed, write NaN, or "
          "failed in a column status.",
          found_.without_reading, found_.rows));
    }
  }

  const TableStudy& study_;
  Names readings_;
  Names others_;
  std::vector<Row> all_;
  std::string why_;  ///< the first failed run failed
  TableRuns found_;
};

/// What became of the columns, where that may not be what was meant.
void note_columns(const Table& table, const TableColumns& columns, const std::vector<Row>& rows,
                  const Names& unknown_words, std::vector<std::string>& notes) {
  if (table.has_unnamed_row_numbers) {
    notes.push_back(fmt::format(
        "{}: the first column has no name and is taken for the rows' numbers.", table.name));
  }
  if (!columns.unused.empty()) {
    notes.push_back(fmt::format("{}: not used: {}.", table.name, fmt::join(columns.unused, ", ")));
  }
  for (const auto& [reading, column] : columns.sd) {
    const bool is_used =
        std::ranges::any_of(rows, [&](const Row& row) { return row.sds.contains(reading); });
    if (rows.empty()) continue;
    if (is_used) {
      notes.push_back(
          fmt::format("{}: {} is taken for the standard deviation of the runs that a row is the "
                      "mean of, {} for "
                      "how many they are.",
                      table.name, column, *columns.count));
      continue;
    }
    notes.push_back(
        fmt::format("{}: {} is not used: no row says of how many runs it is. Fix: a column n.",
                    table.name, column));
  }
  for (const std::string& setting : columns.settings) {
    std::set<std::string> values;
    for (const TableRow& row : table.rows) values.insert(row.cells[*table.column(setting)]);
    if (values.size() < 2) continue;
    notes.push_back(fmt::format(
        "{}: {} differs between rows ({}), and is no parameter: all rows are taken for runs of the "
        "same model. Fix: make it a parameter, or leave rows with other values out.",
        table.name, setting, fmt::join(values, ", ")));
  }
  if (!unknown_words.empty()) {
    notes.push_back(
        fmt::format("{}: {} says \"{}\", which is not taken for a failure. If it is one, write "
                    "failed.",
                    table.name, *columns.status, fmt::join(unknown_words, "\", \"")));
  }
}

Names parameters_of(const TableStudy& study) {
  Names names;
  for (const Parameter& parameter : study.parameters) names.push_back(parameter.name);
  return names;
}

std::vector<WantedColumn> wanted_columns(const TableStudy& study) {
  std::vector<WantedColumn> wanted;
  for (const Parameter& parameter : study.parameters) wanted.push_back({parameter.name});
  for (const auto* observables : {&study.measured, &study.held_out}) {
    for (const Observable& one : *observables) wanted.push_back({one.name, one.unit});
  }
  return wanted;
}

void take_rows_without_runs(const TableStudy& study, Table& table, std::vector<std::string>& notes,
                            base::Faults& faults) {
  const OtherRows other =
      take_other_rows(table, readings_of(study), Unlabelled::noted, faults, parameters_of(study));
  for (const auto& [what, why] : other.left_out) {
    notes.push_back(fmt::format("{}: {} is not used ({})", table.name, what, why));
  }
  notes.insert(notes.end(), other.notes.begin(), other.notes.end());
}

/// Cells are not parted by commas, and some number has one.
bool writes_decimal_commas(const Table& table) {
  if (table.delimiter == ',') return false;
  return std::ranges::any_of(table.rows, [](const TableRow& row) {
    return std::ranges::any_of(row.cells, [](const std::string& cell) {
      return cell.find(',') != std::string::npos && number_of(cell).has_value();
    });
  });
}

}  // namespace

TableRuns read_table_runs(const TableStudy& study, const std::vector<std::filesystem::path>& files,
                          NoRows no_rows) {
  Collector collector(study);
  base::Faults faults;
  std::vector<std::string> notes;
  TableRuns found;
  for (const std::filesystem::path& file : files) {
    try {
      found.texts.push_back(base::read_whole_file(file));
      Table table = parse_table(file.string(), found.texts.back(), no_rows);
      found.files.push_back(file.filename().string());
      base::Faults own;
      take_names_without_units(wanted_columns(study), table, notes, own);
      if (found.columns.empty()) {
        found.columns = table.columns;
        // Others than the usual ones are told by a line of their own, which rows have not.
        found.delimiter = table.delimiter == '|' ? ';' : table.delimiter;
        found.has_decimal_comma = writes_decimal_commas(table);
      }
      const PicturedCells pictured = measure_pictured_cells(study, file.parent_path(), table, own);
      notes.insert(notes.end(), pictured.notes.begin(), pictured.notes.end());
      found.texts.insert(found.texts.end(), pictured.fingerprints.begin(),
                         pictured.fingerprints.end());
      take_rows_without_runs(study, table, notes, own);
      RowReader reader(study, table, own);
      std::vector<Row> rows = reader.rows();
      own.throw_if_any();
      for (Row& row : rows) {
        if (const auto of = pictured.sds.find(row.line); of != pictured.sds.end()) {
          row.own_sds = of->second;
        }
      }
      note_columns(table, reader.columns(), rows, reader.unknown_words(), notes);
      collector.add(table.name, reader.columns(), rows);
    } catch (const base::InputError& error) {
      faults.add_all(error.faults());
    }
  }
  faults.throw_if_any();
  TableRuns made = collector.take();
  constexpr int kMaxRows = 1000;
  if (made.rows > kMaxRows) {
    base::refuse(
        fmt::format("{}", fmt::join(found.files, ", ")),
        fmt::format("has {} rows within the bounds; surfaces through more than {} take "
                    "hours",
                    made.rows, kMaxRows),
        "put repeats together: their mean, with columns NAME_sd and n; or leave rows out.");
  }
  made.files = std::move(found.files);
  made.columns = std::move(found.columns);
  made.delimiter = found.delimiter;
  made.has_decimal_comma = found.has_decimal_comma;
  made.texts = std::move(found.texts);
  made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
  return made;
}

}  // namespace repose::calibrate
