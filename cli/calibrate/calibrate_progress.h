#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "calibrate/study/job_runner.h"

namespace repose::cli {

/// How far a study is, on standard error. On a terminal one line that is written over, with the
/// time left of the stage; else a line for each stage.
class StudyProgressLine {
 public:
  StudyProgressLine();
  ~StudyProgressLine();
  StudyProgressLine(const StudyProgressLine&) = delete;
  StudyProgressLine& operator=(const StudyProgressLine&) = delete;
  StudyProgressLine(StudyProgressLine&&) = delete;
  StudyProgressLine& operator=(StudyProgressLine&&) = delete;

  void tell(const calibrate::StudyProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  const bool is_terminal_;
  std::string stage_;
  Clock::time_point stage_start_ = Clock::now();
};

}  // namespace repose::cli
