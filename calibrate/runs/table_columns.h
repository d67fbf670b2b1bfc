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

/// The roles of the columns of a table of runs, and the meaning of words in it.
namespace repose::calibrate {

std::string in_small_letters(std::string_view text);

// For a cell in lower case.

bool is_nothing(const std::string& small);   ///< no entry
bool says_failed(const std::string& small);  ///< written where a run gave no number
bool says_done(const std::string& small);

/// The first few of them, and the number of the others.
std::string listed(const std::vector<std::string>& all, std::string_view between = ", ");

/// The roles of the columns of one table.
struct TableColumns {
  std::vector<std::string> parameters;
  std::vector<std::string> readings;      ///< those of the study, and others with numbers
  std::size_t measured = 0;               ///< number of these that are the study's
  std::map<std::string, std::string> sd;  ///< by reading
  std::optional<std::string> count;
  std::optional<std::string> seed;
  std::optional<std::string> status;
  std::vector<std::string> settings;  ///< of the model, not fitted by the study
  std::vector<std::string> unused;
};

/// Name of a column in a study, and the unit expected there; empty: any.
struct WantedColumn {
  std::string name;
  std::string unit = {};
};

/// Renames columns to the wanted names if these are followed by a unit in brackets: "sliding
/// friction [-]" becomes "sliding friction" unless a column has exactly that name.
/// @param notes   each, a sentence
/// @param faults  columns in a different unit
void take_names_without_units(const std::vector<WantedColumn>& wanted, Table& table,
                              std::vector<std::string>& notes, base::Faults& faults);

/// @param faults  missing columns are added
TableColumns columns_of(const TableStudy& study, const Table& table, base::Faults& faults);

}  // namespace repose::calibrate
