#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "calibrate/run/run_study.h"
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

/// What a study says on its way, on standard error: how far it is, and what to know.
class StudyMessages {
 public:
  /// Lives as long as this.
  calibrate::StudyWatch watch(const std::atomic<bool>& is_interrupted);

 private:
  std::optional<StudyProgressLine> line_;
};

/// Carries out `repose calibrate`.
ExitCode run_calibrate(const CalibrateArguments& arguments);

}  // namespace repose::cli
