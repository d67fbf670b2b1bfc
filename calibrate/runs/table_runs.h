#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// Outcome of a row's run.
enum class RowEnd { reading, failed, nothing };

/// Contents of tables of runs.
struct TableRuns {
  /// Runs of each reading separately, which is its own experiment: a row gives one run for each
  /// reading that it has a number of. Rows that failed are counted, and give none.
  std::vector<Run> runs;
  std::vector<std::string> run_rows;  ///< origin of each of these: "runs.csv:14"
  /// Columns of numbers that the study does not name, with their runs: the advice says what
  /// measuring them would reveal.
  std::vector<Offer> others;
  /// Of all rows within the bounds, whatever their outcome.
  std::vector<std::vector<double>> places;
  std::vector<RowEnd> ends;          ///< of each of these; failed if any reading failed
  std::vector<std::string> files;    ///< without their folders, as far as the names are unique
  std::vector<std::string> columns;  ///< of the first table
  char delimiter = ',';              ///< likewise
  bool has_decimal_comma = false;    ///< likewise: at least one of its numbers has one
  std::vector<std::string> texts;    ///< of the files
  int rows = 0;                      ///< rows that count: `places`
  int failed = 0;                    ///< of these, with a status or a NaN that says so
  int without_reading = 0;           ///< of these, with no reading at all
  int left_out = 0;                  ///< in addition to these: outside the bounds, or copies
  std::vector<std::string> notes;    ///< remarks on the rows, a sentence each
};

/// The rows of tables whose columns are the study's parameters and readings and, optionally:
///   - NAME_sd (_std, _stdev), the sd of the runs that a row is the mean of, and n (n_ok, repeats,
///     seeds, ...), their number;
///   - seed;
///   - status: a word for failure marks the row as a failed run.
/// A reading may be empty, which says nothing, or NaN, which says that the run failed. Text columns
/// are not used.
///
/// @throws base::InputError  every error: columns that are missing, cells that are not numbers,
/// each with its line.
TableRuns read_table_runs(const TableStudy& study, const std::vector<std::filesystem::path>& files,
                          NoRows no_rows = NoRows::refused);

}  // namespace repose::calibrate
