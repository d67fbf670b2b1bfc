#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/run/progress_file.h"
#include "calibrate/run/run_study.h"
#include "calibrate/study/study_work.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {

/// Shows a study's progress on standard error, with the maximum time remaining: a fit that has
/// settled ends earlier. On a terminal a single line that is overwritten, otherwise a line for each
/// stage.
class StudyProgressLine {
 public:
  void report(const calibrate::StudyProgress& progress);

 private:
  calibrate::StudyWork work_;
  ProgressLine line_{"at most {} remaining"};
};

/// Messages of a running study: progress and notes, on standard error and in a file.
class StudyMessages {
 public:
  explicit StudyMessages(const CalibratePlan& plan);

  /// The result must not outlive this object.
  calibrate::StudyWatch watch(const std::atomic<bool>& is_interrupted);

 private:
  void tell_round(const calibrate::StudyProgress& progress);

  const std::vector<calibrate::Parameter> parameters_;
  calibrate::ProgressFile file_;
  std::optional<StudyProgressLine> line_;
  std::size_t rounds_told_ = 0;
};

/// Runs `repose calibrate`.
ExitCode run_calibrate(const CalibrateArguments& arguments);

}  // namespace repose::cli
