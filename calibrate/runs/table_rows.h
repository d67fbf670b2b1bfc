#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/runs/table_columns.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// A row of a table of runs, as numbers.
struct RunRow {
  int line = 0;
  std::string where;                                   ///< "runs.csv:14"
  std::vector<double> values;                          ///< of the parameters
  std::map<std::string, std::optional<double>> reads;  ///< std::nullopt: empty, or the run failed
  std::map<std::string, double> sds;
  std::map<std::string, double> own_sds;  ///< of readings measured in pictures
  std::optional<std::uint64_t> seed;
  int repeats = 1;
  std::string failure;                          ///< of all readings
  std::map<std::string, std::string> failures;  ///< of one reading
};

/// The rows of one table.
struct RunRows {
  TableColumns columns;
  std::vector<RunRow> rows;
  std::vector<std::string> unknown_words;  ///< found where a status is expected
  std::vector<std::string> notes;          ///< on single cells, a sentence each
};

/// @param faults  appended to: columns that are missing, cells that are not numbers or are
///   impossible, each with its line
RunRows run_rows(const TableStudy& study, const Table& table, base::Faults& faults);

}  // namespace repose::calibrate
