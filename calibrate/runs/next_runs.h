#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// A run worth making.
struct NextRun {
  std::vector<double> values;  ///< of the parameters
  std::string reason;          ///< a sentence without its full stop
};

struct NextRuns {
  std::vector<NextRun> runs;
  /// Why there are fewer than requested, and what would narrow the answer instead; otherwise empty.
  std::vector<std::string> settled;
  std::string left_out;  ///< where runs are likely to fail and none is suggested; otherwise empty
};

/// The next runs of a study of a table, at most `count`. As long as too few places have readings
/// for a fit, they fill the bounds evenly, some of them twice if the random scatter is not known
/// yet; then they are where they narrow the answer most (best_places.h), one in eight elsewhere,
/// until the surfaces through them would be known better than the bench's means. None is where more
/// of the runs nearby failed than gave a reading (FailureRisk, misfit.h): a single failure among
/// successes excludes half the way to them, and the more failed there, the farther. Among runs near
/// each other, at most half a failure is expected. Proved by NextRunsTest.* in tests/calibrate.
/// @throws base::InputError  the problem is not sound.
NextRuns next_runs(const TableStudy& study, const TableRuns& table, std::size_t count);

/// A table of them, to be filled in: the columns of the first table read, or the parameters and
/// readings if there is none, and a column "reason". In the format of that table, so that rows can
/// be appended to it.
Table next_runs_table(const TableStudy& study, const TableRuns& table,
                      const std::vector<NextRun>& runs);

}  // namespace repose::calibrate
