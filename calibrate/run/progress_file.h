#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/study_work.h"

namespace repose::calibrate {

/// Progress of a study, as a file for programs that is rewritten about once a second, each time as
/// a whole. A write error does not stop the study.
class ProgressFile {
 public:
  /// @param file  empty: no file is written
  ProgressFile(std::filesystem::path file, std::vector<Parameter> parameters);

  void report(const StudyProgress& progress);
  /// Adds a note for the user.
  void note(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  void write();

  const std::filesystem::path file_;
  const std::vector<Parameter> parameters_;
  StudyProgress progress_;
  StudyWork work_;
  std::vector<std::string> notes_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_written_ = start_;
};

}  // namespace repose::calibrate
