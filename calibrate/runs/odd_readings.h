#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/runs/table_runs.h"

namespace repose::calibrate {

/// A reading of a table far from what all other rows predict there.
struct OddReading {
  std::string where;  ///< "runs.csv:14"
  std::string name;   ///< of the reading
  double value = 0;
  Interval expected;  ///< 95 %, of one run there, from the surface through the others

  /// "aor = 272 in runs.csv:14, where the other rows expect 24.1 to 29.6".
  std::string text() const;
};

/// Up to three of each reading, the farthest first. An outlier hides in the scatter that it creates
/// itself, and two hide each other, so the most suspicious ones are left out one by one, each is
/// compared with the surface through the rest, and the last one that is too far off makes all
/// before it odd as well: Rosner (1983), Technometrics 25, 165, with a surface in place of the
/// mean. The limit is six standard deviations of a further run there, which normal chance exceeds
/// in one row of 10^8 and Student's t with ten degrees of freedom in one of 10^4, and a quarter of
/// the range of the others, so that details that a smooth surface does not follow are not taken for
/// errors. Proved by OddReadings.* in tests/calibrate/odd_tables_test.cpp.
std::vector<OddReading> odd_readings(const Problem& problem, const TableRuns& table);

}  // namespace repose::calibrate
