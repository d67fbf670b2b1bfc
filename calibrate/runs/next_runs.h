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
  /// Why there are fewer than asked for, and what would narrow the answer in their place; else
  /// empty.
  std::vector<std::string> settled;
  std::string left_out;  ///< where runs are likely to fail and none is asked for; else empty
};

/// The next runs of a study of a table, `count` of them at most. As long as too few places have
/// readings for a fit, they fill the bounds evenly, some of them twice where it is not known yet
/// what chance does; then they are where they narrow the answer most (rounds.h), one in eight
/// elsewhere, until the surfaces through them would be known better than the bench's means. None is
/// where more of the runs nearby failed than gave a reading (FailureRisk, misfit.h): around a
/// failure among others that is half the way to them, and the more failed there, the farther from
/// them. Of those near each other, half a failure is expected at most. Proved by NextRunsTest.* in
/// tests/calibrate.
/// @throws base::InputError  the problem is not sound.
NextRuns next_runs(const TableStudy& study, const TableRuns& table, std::size_t count);

/// A table of them, to be filled in: the columns of the first table that was read, or the
/// parameters and readings where there is none, and a column "reason". Written as that table is, so
/// that rows can be put below it.
Table next_runs_table(const TableStudy& study, const TableRuns& table,
                      const std::vector<NextRun>& runs);

}  // namespace repose::calibrate
