#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/study/job_runner.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {

/// How far a study is, on standard error, with the time left of all of it, at most: a fit that has
/// settled ends earlier. On a terminal one line that is written over, else a line for each stage.
class StudyProgressLine {
 public:
  void report(const calibrate::StudyProgress& progress);

 private:
  std::string stage_;
  double earlier_s_ = 0;  ///< work of the stages before this one
  double stage_s_ = 0;    ///< work done in this one
  ProgressLine line_{"at most {} remaining"};
};

/// The value nearest to the mean of all, of which there is one at least; of equals the first.
/// @return its number
std::size_t most_typical(const std::vector<double>& values);

/// Leaves the heaps of the last check in the study's folder, to look at and to compare with
/// photographs: all in `heaps`, that of the most typical angle also as `heap.vtp`. Those of an
/// earlier result go away: what is of other coefficients must not stand for these.
/// @throws base::InputError  the folder cannot be written.
void save_check_heaps(const CalibratePlan& plan, const calibrate::StudyContext& context,
                      const std::vector<calibrate::Run>& checks);

/// Carries out `repose calibrate`.
ExitCode run_calibrate(const CalibrateArguments& arguments);

}  // namespace repose::cli
