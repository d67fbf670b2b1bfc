#pragma once

#include <string>

#include "calibrate/study/study_context.h"
#include "cli/common/progress.h"

namespace repose::cli {

/// How far a study is, on standard error. On a terminal one line that is written over, with the
/// time left of the stage; else a line for each stage.
class StudyProgressLine {
 public:
  void report(const calibrate::StudyProgress& progress);

 private:
  std::string stage_;
  ProgressLine line_;
};

}  // namespace repose::cli
