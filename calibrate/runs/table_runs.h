#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// What became of a row's run.
enum class RowEnd { reading, failed, nothing };

/// What is in tables of runs.
struct TableRuns {
  /// Of each reading by itself, which is its own experiment: a row gives a run of each that it has
  /// a number of. Rows that failed are counted, and give none.
  std::vector<Run> runs;
  std::vector<std::string> run_rows;  ///< where each of these stands: "runs.csv:14"
  /// Columns of numbers that the study does not name, with their runs: what measuring them would
  /// tell is advised.
  std::vector<Offer> others;
  /// Of all rows within the bounds, whatever became of them.
  std::vector<std::vector<double>> places;
  std::vector<RowEnd> ends;          ///< of each of these; with one reading that failed: failed
  std::vector<std::string> files;    ///< without their folders, as far as names tell them apart
  std::vector<std::string> columns;  ///< of the first table
  char delimiter = ',';              ///< likewise
  bool has_decimal_comma = false;    ///< likewise: some number of its is written with one
  std::vector<std::string> texts;    ///< of the files
  int rows = 0;                      ///< that count: `places`
  int failed = 0;                    ///< of these, with a status or a NaN that says so
  int without_reading = 0;           ///< and with no reading at all
  int left_out = 0;                  ///< beside these: outside the bounds, or copies
  std::vector<std::string> notes;    ///< what was made of the rows, a sentence each
};

/// The rows of tables whose columns are the study's parameters and readings, and beside these, if
/// they have them:
///   - NAME_sd (_std, _stdev), the sd of the runs that a row is the mean of, and n (n_ok, repeats,
///     seeds, ...), how many they are;
///   - seed;
///   - status: a word for failure makes the row one of a failed run.
/// A reading may be empty, which says nothing, or NaN, which says that the run failed. Text columns
/// are not used.
///
/// @throws base::InputError  every error: columns that are missing, cells that are no numbers, each
/// with its line.
TableRuns read_table_runs(const TableStudy& study, const std::vector<std::filesystem::path>& files,
                          NoRows no_rows = NoRows::refused);

}  // namespace repose::calibrate
