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
#include "calibrate/runs/table_rows.h"
#include "calibrate/statistics/table/other_rows.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// Combines the rows of all tables.
class Collector {
 public:
  explicit Collector(const TableStudy& study) : study_(study), readings_(readings_of(study)) {}

  void add(const std::string& file, const TableColumns& columns, std::vector<RunRow> rows) {
    for (std::size_t k = columns.measured; k < columns.readings.size(); ++k) {
      if (std::ranges::find(others_, columns.readings[k]) == others_.end()) {
        others_.push_back(columns.readings[k]);
      }
    }
    int outside = 0;
    std::string first;
    for (RunRow& row : rows) {
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
    for (const RunRow& row : all_) {
      found_.places.push_back(row.values);
      found_.ends.push_back(add_runs(row));
    }
    for (const std::string& other : others_) add_offer(other);
    count_failures();
    return std::move(found_);
  }

 private:
  std::string outside_of(const RunRow& row) const {
    for (std::size_t j = 0; j < row.values.size(); ++j) {
      const Parameter& parameter = study_.parameters[j];
      if (row.values[j] >= parameter.min && row.values[j] <= parameter.max) continue;
      return fmt::format("{} is {:g}, the bounds are {:g} and {:g}", parameter.name, row.values[j],
                         parameter.min, parameter.max);
    }
    return {};
  }

  /// A run that failed or is still to be made: identical ones are not copies.
  static bool says_nothing(const RunRow& row) {
    return !row.failure.empty() ||
           std::ranges::none_of(row.reads, [](const auto& one) { return one.second.has_value(); });
  }

  static bool is_copy(const RunRow& one, const RunRow& other) {
    return one.reads == other.reads && one.failures == other.failures;
  }

  /// Comparison of the rows at one place.
  struct Repeats {
    std::set<std::size_t> copies;  ///< the same numbers once more
    bool differ = false;           ///< some show random scatter
    int same_seed = 0;             ///< rows with the same seed but different readings
  };

  void compare(const std::vector<std::size_t>& rows, std::size_t i, Repeats& repeats) const {
    bool is_one = false, is_first = true;
    for (std::size_t j = 0; j < i; ++j) {
      const RunRow &row = all_[rows[i]], &before = all_[rows[j]];
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

  /// Rows at one place are runs with different seeds. Identical numbers are a copy if others show
  /// random scatter; otherwise they are what a repeated run gives.
  void number_repeats() {
    std::map<std::vector<double>, std::vector<std::size_t>> by_place;
    for (std::size_t k = 0; k < all_.size(); ++k) by_place[all_[k].values].push_back(k);
    Repeats repeats;
    // The repeats that a row is the mean of also show it.
    repeats.differ = std::ranges::any_of(all_, [](const RunRow& row) {
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
    std::vector<RunRow> kept;
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

  static std::optional<Run> run_of(const RunRow& row, const std::string& reading) {
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
      run.reading_sd["value"] = own->second;  // of one run, even if other readings are means
      return run;
    }
    run.repeats = row.repeats;
    if (const auto sd = row.sds.find(reading); sd != row.sds.end()) {
      run.repeat_sd["value"] = sd->second;
    }
    return run;
  }

  RowEnd add_runs(const RunRow& row) {
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
    if (has_failed) return RowEnd::failed;
    if (!has_any) ++found_.without_reading;
    return has_any ? RowEnd::reading : RowEnd::nothing;
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
    for (const RunRow& row : all_) {
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
  std::vector<RunRow> all_;
  std::string why_;  ///< failure of the first failed run
  TableRuns found_;
};

/// Notes the use of columns that may not be as intended.
void note_columns(const Table& table, const RunRows& read, std::vector<std::string>& notes) {
  const TableColumns& columns = read.columns;
  const auto note = [&](const std::string& text) {
    notes.push_back(fmt::format("{}: {}", table.name, text));
  };
  if (table.has_unnamed_row_numbers) {
    note("the first column has no name and is taken for the rows' numbers.");
  }
  Names unused = columns.unused;
  // Columns that repose writes there itself need no note.
  std::erase_if(unused, [](const std::string& name) { return name == "run" || name == "reason"; });
  if (!unused.empty()) note(fmt::format("not used: {}.", listed(unused)));
  for (const auto& [reading, column] : columns.sd) {
    if (read.rows.empty()) continue;
    const bool is_used = std::ranges::any_of(
        read.rows, [&](const RunRow& row) { return row.sds.contains(reading); });
    note(is_used ? fmt::format("{} is taken for the standard deviation of the runs that a row is "
                               "the mean of, {} for how many they are.",
                               column, *columns.count)
                 : fmt::format("{} is not used: no row says of how many runs it is. Fix: a column "
                               "n.",
                               column));
  }
  for (const std::string& setting : columns.settings) {
    std::set<std::string> values;
    for (const TableRow& row : table.rows) values.insert(row.cells[*table.column(setting)]);
    if (values.size() < 2) continue;
    note(fmt::format(
        "{} differs between rows ({}), and is no parameter: all rows are taken for runs of the "
        "same model. Fix: make it a parameter, or leave rows with other values out.",
        setting, listed({values.begin(), values.end()})));
  }
  if (!read.unknown_words.empty()) {
    note(
        fmt::format("{} says \"{}\", which is not taken for a failure. If it is one, write failed.",
                    *columns.status, listed(read.unknown_words, "\", \"")));
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

/// Whether cells are not separated by commas, and some number contains one.
bool writes_decimal_commas(const Table& table) {
  if (table.delimiter == ',') return false;
  return std::ranges::any_of(table.rows, [](const TableRow& row) {
    return std::ranges::any_of(row.cells, [](const std::string& cell) {
      return cell.find(',') != std::string::npos && number_of(cell).has_value();
    });
  });
}

/// The names of the files in results, wherever they are stored: the file name, preceded by folders
/// if others have the same name.
Names short_names_of(const std::vector<fs::path>& files) {
  Names names;
  for (const fs::path& file : files) {
    const auto ends_with = [](const fs::path& whole, const fs::path& end) {
      const auto size = std::distance(end.begin(), end.end());
      return std::distance(whole.begin(), whole.end()) >= size &&
             std::equal(end.begin(), end.end(), std::prev(whole.end(), size));
    };
    fs::path name = file.filename();
    for (fs::path left = file.parent_path(); left.has_filename(); left = left.parent_path()) {
      if (std::ranges::count_if(files, [&](const auto& one) { return ends_with(one, name); }) < 2) {
        break;
      }
      name = left.filename() / name;
    }
    names.push_back(name.string());
  }
  return names;
}

/// Reads tables, one after the other.
class TablesReader {
 public:
  explicit TablesReader(const TableStudy& study) : study_(study), collector_(study) {}

  /// @param name  used for it in the result
  void read(const fs::path& file, const std::string& name, NoRows no_rows) {
    found_.texts.push_back(base::read_whole_file(file));
    Table table = parse_table(file.string(), found_.texts.back(), no_rows);
    found_.files.push_back(name);
    std::vector<std::string> notes;
    base::Faults faults;
    take_names_without_units(wanted_columns(study_), table, notes, faults);
    if (found_.columns.empty()) {
      found_.columns = table.columns;
      // Unusual delimiters are declared in a line of their own, which rows do not have.
      found_.delimiter = table.delimiter == '|' ? ';' : table.delimiter;
      found_.has_decimal_comma = writes_decimal_commas(table);
    }
    const PicturedCells pictured =
        measure_pictured_cells(study_, file.parent_path(), table, faults);
    notes.insert(notes.end(), pictured.notes.begin(), pictured.notes.end());
    found_.texts.insert(found_.texts.end(), pictured.fingerprints.begin(),
                        pictured.fingerprints.end());
    take_rows_without_runs(study_, table, notes, faults);
    RunRows read = run_rows(study_, table, faults);
    faults.throw_if_any();
    note_columns(table, read, notes);
    notes.insert(notes.end(), read.notes.begin(), read.notes.end());
    // Error messages name the file's location; the result is the same wherever it is.
    const auto shorten = [&](std::string& text) {
      if (text.starts_with(table.name)) text.replace(0, table.name.size(), name);
    };
    for (RunRow& row : read.rows) {
      const auto sds = pictured.sds.find(row.line);
      if (sds != pictured.sds.end()) row.own_sds = sds->second;
      shorten(row.where);
    }
    std::ranges::for_each(notes, shorten);
    notes_.insert(notes_.end(), notes.begin(), notes.end());
    collector_.add(name, read.columns, std::move(read.rows));
  }

  /// Contents of all of them together.
  TableRuns take() {
    TableRuns all = collector_.take();
    constexpr int kMaxRows = 1000;
    if (all.rows > kMaxRows) {
      base::refuse(
          fmt::format("{}", fmt::join(found_.files, ", ")),
          fmt::format("has {} rows within the bounds; surfaces through more than {} take hours",
                      all.rows, kMaxRows),
          "put repeats together: their mean, with columns NAME_sd and n; or leave rows out.");
    }
    all.files = std::move(found_.files);
    all.columns = std::move(found_.columns);
    all.delimiter = found_.delimiter;
    all.has_decimal_comma = found_.has_decimal_comma;
    all.texts = std::move(found_.texts);
    all.notes.insert(all.notes.begin(), notes_.begin(), notes_.end());
    return all;
  }

 private:
  const TableStudy& study_;
  Collector collector_;
  TableRuns found_;
  std::vector<std::string> notes_;
};

}  // namespace

TableRuns read_table_runs(const TableStudy& study, const std::vector<std::filesystem::path>& files,
                          NoRows no_rows) {
  TablesReader reader(study);
  base::Faults faults;
  const Names names = short_names_of(files);
  for (std::size_t k = 0; k < files.size(); ++k) {
    try {
      reader.read(files[k], names[k], no_rows);
    } catch (const base::InputError& error) {
      faults.add_all(error.faults());
    }
  }
  faults.throw_if_any();
  return reader.take();
}

}  // namespace repose::calibrate
