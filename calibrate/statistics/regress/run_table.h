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

/// The roles of the columns of a table of runs.
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
  std::vector<LeftOut> left_out;  ///< unused rows and columns, except columns left out by naming
                                  ///< the factors
  std::vector<std::string> notes;
};

/// The runs of a table, without rows that are not runs (take_other_rows).
///
/// Blocks, unless named: a column of text in which each of two or more words occurs in two or more
/// rows, or one of numbers that is called "block", "batch", "operator" or the like.
///
/// Without `factors`, all columns count except the response, blocks, and what design programs and
/// people write beside them: columns with such names ("run", "StdOrder", "PtType", "NAME_coded"),
/// those that hold each number from 0 or 1 on once, as a run order does (unless no other column
/// would be a factor), and text.
///
/// Coding: the levels in `codings`, if the factor is named there. Otherwise a column that contains
/// -1 and +1 and has opposite extremes is assumed to be coded already; any other has its lowest
/// level at -1 and its highest at +1, of the runs whose `point` is "cube" if there are such.
///
/// @throws base::InputError  every error: missing columns, cells that are not numbers, a coding for
/// something that is not a factor, several columns that may be blocks, rows that look like a mean.
TableOfRuns runs_in(Table table, const RunColumns& columns);

}  // namespace repose::calibrate
