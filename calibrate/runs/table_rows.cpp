#include "calibrate/runs/table_rows.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace repose::calibrate {
namespace {

using Names = std::vector<std::string>;

/// The rows of one table.
class RowReader {
 public:
  RowReader(const TableStudy& study, const Table& table, base::Faults& faults)
      : study_(study), table_(table), columns_(columns_of(study, table, faults)), faults_(faults) {}

  const TableColumns& columns() const { return columns_; }

  std::vector<RunRow> rows() {
    std::vector<RunRow> rows(table_.rows.size());
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

  /// For readings like "1.837" among others of 1790 to 1980, in a table whose other points are
  /// decimal ones. They may be of runs that went wrong, so they count.
  std::vector<std::string> notes_of_thousands(const std::vector<RunRow>& rows) const {
    std::vector<std::string> notes;
    for (const auto* observables : {&study_.measured, &study_.held_out}) {
      for (const Observable& one : *observables) {
        if (auto note = note_of_thousands(one, rows); !note.empty()) {
          notes.push_back(std::move(note));
        }
      }
    }
    return notes;
  }

 private:
  std::string note_of_thousands(const Observable& one, const std::vector<RunRow>& rows) const {
    constexpr double kThousand = 1000, kFarBelow = .1, kNear = 2;
    std::vector<double> sure = {std::abs(one.mean)}, doubtful;
    Names where;
    const auto is_doubtful = [&](std::size_t row) {
      return may_have_thousands(cell(table_.rows[row], one.name), '.');
    };
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto value = rows[row].reads.at(one.name);
      if (value && !is_doubtful(row)) sure.push_back(std::abs(*value));
    }
    const auto [low, high] = std::ranges::minmax(sure);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto value = rows[row].reads.at(one.name);
      if (!value || !is_doubtful(row) || std::abs(*value) > kFarBelow * low) continue;
      const double thousands = kThousand * std::abs(*value);
      if (thousands < low / kNear || thousands > high * kNear) continue;
      doubtful.push_back(kThousand * *value);
      where.push_back(fmt::format("{:g} in line {}", *value, rows[row].line));
    }
    if (where.empty()) return {};
    return fmt::format(
        "{}: {} is {}, and from {:g} to {:g} elsewhere. It counts as it is; where a point parts "
        "thousands, write {:g} without it.",
        table_.name, one.name, listed(where), low, high, doubtful.front());
  }

  const std::string& cell(const TableRow& row, const std::string& column) const {
    return row.cells[*table_.column(column)];
  }

  base::Fault fault_at(int line, const std::string& column, std::string value, std::string fix) {
    return {.where = fmt::format("{}:{}", table_.name, line),
            .subject = column,
            .value = std::move(value),
            .fix = std::move(fix)};
  }

  /// Numeric columns in which a row may lack a value: words are read as 0, and skipped.
  Names sparse_columns() const {
    Names names = columns_.readings;
    for (const auto& [reading, column] : columns_.sd) names.push_back(column);
    for (const auto& column : {columns_.count, columns_.seed}) {
      if (column) names.push_back(*column);
    }
    return names;
  }

  void read_numbers(std::vector<RunRow>& rows) {
    // The meaning of a point or a comma is determined from all numbers together.
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
      RunRow& row = rows[k];
      for (std::size_t j = 0; j < columns_.parameters.size(); ++j) row.values.push_back(all[j][k]);
      for (const std::string& reading : columns_.readings) {
        row.reads[reading] = number(reading, k);
        if (row.reads[reading] && std::abs(*row.reads[reading]) > kMaxReading) {
          cells.add(fault_at(row.line, reading, fmt::format("is {:g}", *row.reads[reading]),
                             "failed, as a word, where the run failed; or another unit."));
        }
        check_range(row, reading, cells);
      }
      read_repeats(row, k, number, cells);
    }
    faults_.add_all(cells.all());
  }

  /// An angle of 9999 degrees indicates a failed run.
  void check_range(const RunRow& row, const std::string& reading, base::Faults& cells) {
    const auto value = row.reads.at(reading);
    for (const auto* observables : {&study_.measured, &study_.held_out}) {
      for (const Observable& one : *observables) {
        if (!value || one.name != reading) continue;
        if (*value >= one.least && *value <= one.most) continue;
        cells.add(fault_at(row.line, reading,
                           fmt::format("is {:g}: in {}, readings are from {:g} to {:g}", *value,
                                       one.unit, one.least, one.most),
                           "failed, as a word, where the run failed; or another unit."));
      }
    }
  }

  template <typename Number>
  void read_repeats(RunRow& row, std::size_t k, const Number& number, base::Faults& cells) {
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

  void read_words(const TableRow& cells, RunRow& row) {
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
  const Table& table_;
  TableColumns columns_;
  base::Faults& faults_;
  std::set<std::string> unknown_;
};

}  // namespace

RunRows run_rows(const TableStudy& study, const Table& table, base::Faults& faults) {
  RowReader reader(study, table, faults);
  std::vector<RunRow> rows = reader.rows();
  std::vector<std::string> notes;
  if (faults.empty()) notes = reader.notes_of_thousands(rows);
  return {.columns = reader.columns(),
          .rows = std::move(rows),
          .unknown_words = reader.unknown_words(),
          .notes = std::move(notes)};
}

}  // namespace repose::calibrate
