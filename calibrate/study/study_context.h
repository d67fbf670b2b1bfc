#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "calibrate/experiment/run_folder.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_simulator.h"

namespace repose::calibrate {

/// How far a study is.
struct StudyProgress {
  std::string stage;  ///< "round 2 of at most 4", "check 1 of at most 3"
  int done = 0;       ///< jobs of this stage
  int of = 0;
  double seconds_done = 0;  ///< estimated work of those, s of one core
  double seconds_of = 0;
  std::optional<double> seconds_later;  ///< of the stages that follow, at most; none: unknown
};

/// By what a study's jobs are done, whatever its method. All of it must outlive the study.
struct StudyContext {
  const StudySimulator& simulator;
  const RunFolder& folder;
  Executor& executor;
  const std::atomic<bool>& is_interrupted;
  std::function<void(const StudyProgress&)> report = [](const StudyProgress&) {};
};

}  // namespace repose::calibrate
