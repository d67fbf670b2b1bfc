#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/regress/regression.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// What the columns of a table of runs are.
struct RunColumns {
  std::string response;
  std::vector<std::string> factors = {};  ///< empty: see runs_in
  std::string blocks = {};                ///< empty: see runs_in; kNoBlocks: there are none
  std::vector<Factor> codings = {};
  base::FieldNames names = {};  ///< how the user gives "blocks column", for notes
};

inline constexpr std::string_view kNoBlocks = "none";

struct TableOfRuns {
  RunTable runs;
  std::vector<LeftOut> left_out;  ///< rows and columns that are not used, but for columns left out
                                  ///< by naming the factors
  std::vector<std::string> notes;
};

/// The runs of a table, without rows that are none (take_other_rows).
///
/// Blocks, where none are named: a column of text in which each of two or more words stands in two
/// or more rows, or one of numbers that is called "block", "batch", "operator" or the like.
///
/// Without `factors`, these are all columns but the response, blocks, and what programs for designs
/// and people write beside them: columns called so ("run", "StdOrder", "PtType", "NAME_coded"),
/// those that hold each number from 0 or 1 on once, as the order of runs does (unless no other
/// column would be a factor), and text.
///
/// Coding: the levels in `codings`, where the factor is named there. Otherwise a column that has
/// -1 and +1 and whose extremes are opposite is taken for coded already; any other has its lowest
/// level at -1 and its highest at +1, of the runs whose `point` is "cube" where there are such.
///
/// @throws base::InputError  every error: missing columns, cells that are no numbers, a coding
/// for what is no factor, several columns that may be blocks, rows that look like a mean.
TableOfRuns runs_in(Table table, const RunColumns& columns);

}  // namespace repose::calibrate
