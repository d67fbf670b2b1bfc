#pragma once

#include <string>

#include "calibrate/study/job_runner.h"
#include "cli/common/progress.h"

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

}  // namespace repose::cli
