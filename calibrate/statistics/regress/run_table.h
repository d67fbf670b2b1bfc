#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibrate/statistics/regress/regression.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// The runs of a table. Without `factors`, these are all columns but the response and those that a
/// design has besides its factors: run, standard, point and NAME_coded.
///
/// Coding: the levels in `codings`, where the factor is named there. Otherwise a column that has
/// -1 and +1 and whose extremes are opposite is taken for coded already; any other has its lowest
/// level at -1 and its highest at +1, of the runs whose `point` is "cube" where there are such.
///
/// @throws std::invalid_argument  every error: missing columns, cells that are no numbers, a coding
/// for what is no factor.
RunTable runs_in(const Table& table, const std::string& response,
                 const std::vector<std::string>& factors, const std::vector<Factor>& codings);

}  // namespace repose::calibrate
