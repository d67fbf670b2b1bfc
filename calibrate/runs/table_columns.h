#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

/// What the columns of a table of runs are, and what words in it mean.
namespace repose::calibrate {

std::string in_small_letters(std::string_view text);

// Of a cell in small letters.

bool is_nothing(const std::string& small);   ///< nothing is said
bool says_failed(const std::string& small);  ///< what is written where a run gave no number
bool says_done(const std::string& small);

/// The first few of them, and how many more there are.
std::string listed(const std::vector<std::string>& all, std::string_view between = ", ");

/// What the columns of one table are.
struct TableColumns {
  std::vector<std::string> parameters;
  std::vector<std::string> readings;      ///< those of the study, and others with numbers
  std::size_t measured = 0;               ///< how many of these are the study's
  std::map<std::string, std::string> sd;  ///< by the reading
  std::optional<std::string> count;
  std::optional<std::string> seed;
  std::optional<std::string> status;
  std::vector<std::string> settings;  ///< of the model, which the study does not seek
  std::vector<std::string> unused;
};

/// What a study calls a column, and the unit in which it means it; empty: any.
struct WantedColumn {
  std::string name;
  std::string unit = {};
};

/// Calls columns by the names wanted that have a unit in brackets behind them: "sliding friction
/// [-]" is "sliding friction" where no column is called just so.
/// @param notes   each, a sentence
/// @param faults  columns in another unit than is meant
void take_names_without_units(const std::vector<WantedColumn>& wanted, Table& table,
                              std::vector<std::string>& notes, base::Faults& faults);

/// @param faults  columns that are missing are added
TableColumns columns_of(const TableStudy& study, const Table& table, base::Faults& faults);

}  // namespace repose::calibrate
