#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/table/table.h"

/// Rows of a spreadsheet's table that are not readings: units below the header, and statistics
/// calculated from the readings, such as their mean.
namespace repose::calibrate {

struct OtherRows {
  std::vector<LeftOut> left_out;
  std::vector<std::string> notes;  ///< what a person should check, a sentence each
};

/// How to treat unlabelled rows at the end that look like statistics.
enum class Unlabelled {
  refused,
  noted,  ///< of runs, which have settings beside the reading: those in the centre are near the
          ///< mean
};

/// Removes these rows from the table:
///   - the first one, if it holds units ("deg", "[mm]") in place of numbers;
///   - those labelled with a word for a statistic: "mean", "SD", "Standardabweichung". Others below
///     the first of these are errors, except "n" and the like, which are removed too.
///
/// Rows at the table's end without such a label, whose numbers are mean, standard deviation and so
/// on of the rows above, are errors if chance gives such readings in less than 1 of 100 tables: by
/// Student's distribution of a further reading (Hahn, Meeker 1991, Statistical Intervals, sec.
/// 4.7), times the step of the last digit. A last row that equals the mean and could be chance, or
/// is not to be refused, is noted. For runs, which have settings beside their readings, such rows
/// are errors if the settings, too, are mean, scatter and so on of those above, and all that by
/// chance in less than 1 of 100 tables: the readings alone in less than 1 of 20, as settings may be
/// meant to be the mean, or with a label missing that all others have. The notes also list readings
/// far from all others, and columns of degrees or percent that look like radians or fractions,
/// unless the rows are runs. Proved by OtherRows.* in tests/calibrate/other_rows_test.cpp.
///
/// @param readings  columns whose numbers were read; those missing in the table are skipped
/// @param errors    appended to, each "NAME:LINE: ... Fix: ..."
/// @param settings  of runs: columns with their settings
OtherRows take_other_rows(Table& table, std::span<const std::string> readings,
                          Unlabelled unlabelled, base::Faults& errors,
                          std::span<const std::string> settings = {});

/// A unit in a cell, with or without brackets, in the form used at the end of column names: "kg_m3"
/// for "[kg/m³]"; empty: not a unit.
std::string unit_in(std::string_view cell);

}  // namespace repose::calibrate
