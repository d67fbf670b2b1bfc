#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/experiment/run_folder.h"
#include "calibrate/study/executor.h"

namespace repose::calibrate {

/// How far a study is.
struct StudyProgress {
  std::string stage;  ///< "round 2", "checking the result"
  int done = 0;       ///< jobs of this stage
  int of = 0;
  double seconds_done = 0;  ///< estimated work of those, s of one core
  double seconds_of = 0;
};

using StudyReport = std::function<void(const StudyProgress&)>;

/// Gets jobs done: from the folder where they are there, else by the executor.
class JobRunner {
 public:
  JobRunner(const Problem& problem, const StudySimulator& simulator, const RunFolder& folder,
            Executor& executor, const StudyReport& report, const std::atomic<bool>& is_interrupted)
      : problem_(problem),
        simulator_(simulator),
        folder_(folder),
        executor_(executor),
        report_(report),
        is_interrupted_(is_interrupted) {}

  /// In the order of the jobs. None when it was interrupted.
  /// @throws std::invalid_argument  a protocol that cannot be run, a folder that cannot be written.
  std::optional<std::vector<Run>> get(const std::string& stage, const std::vector<Job>& jobs);

  int reused() const { return reused_; }
  int simulated() const { return simulated_; }

 private:
  void simulate(const std::string& stage, const std::vector<Job>& jobs,
                const std::vector<std::size_t>& open, std::vector<std::optional<Run>>& runs);
  void keep(const SimulatedJob& done) const;
  double cost_s(const Job& job) const;

  const Problem& problem_;
  const StudySimulator& simulator_;
  const RunFolder& folder_;
  Executor& executor_;
  const StudyReport& report_;
  const std::atomic<bool>& is_interrupted_;
  int reused_ = 0;
  int simulated_ = 0;
};

}  // namespace repose::calibrate
