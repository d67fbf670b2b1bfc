#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/table/table.h"

/// Rows of a spreadsheet's table that are no readings: units below the header, and what somebody
/// worked out of the readings, such as their mean.
namespace repose::calibrate {

struct OtherRows {
  std::vector<LeftOut> left_out;
  std::vector<std::string> notes;  ///< what a person should look at, a sentence each
};

/// What becomes of rows at the end that look like statistics and have no label.
enum class Unlabelled {
  refused,
  noted,  ///< of runs, which have settings beside the reading: those in the centre are near the
          ///< mean
};

/// Takes these rows out of the table:
///   - the first one, where it holds units ("deg", "[mm]") in place of numbers;
///   - those labelled with a word for a statistic: "mean", "SD", "Standardabweichung". Others below
///     the first of these are errors, but for "n" and the like, which are taken out too.
///
/// Rows at the table's end without such a label, whose numbers are mean, standard deviation and so
/// on of the rows above, are errors where chance gives such readings in less than 1 of 100 tables:
/// by Student's distribution of a further reading (Hahn, Meeker 1991, Statistical Intervals, sec.
/// 4.7), times the step of the last digit. A last row that equals the mean and could be chance, or
/// is not to be refused, is in the notes. Of runs, which have settings beside their readings, such
/// rows are errors where the settings, too, are mean, scatter and so on of those above, and all
/// that by chance in less than 1 of 100 tables: the readings alone in less than 1 of 20, as
/// settings may be meant to be the mean, or with a label that is missing where all others have one.
/// In the notes are also readings far from all others, and columns of degrees or percent that look
/// like radians or fractions, unless the rows are runs. Proved by OtherRows.* in
/// tests/calibrate/other_rows_test.cpp.
///
/// @param readings  columns with the numbers that were read; those that the table lacks are passed
///                  over
/// @param errors    are added to, each "NAME:LINE: ... Fix: ..."
/// @param settings  of runs: columns with what they were made at
OtherRows take_other_rows(Table& table, std::span<const std::string> readings,
                          Unlabelled unlabelled, base::Faults& errors,
                          std::span<const std::string> settings = {});

/// A unit as it stands in a cell, with or without brackets, as names of columns end in it: "kg_m3"
/// for "[kg/m³]"; empty: it is none.
std::string unit_in(std::string_view cell);

}  // namespace repose::calibrate
