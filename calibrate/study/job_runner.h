#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/study/executor.h"

/// How a study's jobs are done, whatever its method.
namespace repose::calibrate {

/// How far a study is.
struct StudyProgress {
  std::string stage;  ///< "round 2 of at most 4", "check 1 of at most 3"
  int done = 0;       ///< jobs of this stage
  int of = 0;
  double seconds_done = 0;  ///< estimated work of those, s of one core
  double seconds_of = 0;
  std::optional<double> seconds_later;    ///< of the stages that follow, at most; none: unknown
  std::vector<RoundSummary> rounds = {};  ///< of the fit, those that are complete
};

/// What is known of a study that was interrupted: a fit to what was complete, and not checked.
struct ProvisionalOutcome {
  std::string stage;  ///< that it was interrupted in
  JointFit fit;
  std::vector<Run> runs;  ///< that it was made from
};

/// By what they are done. All of it must outlive the study.
struct StudyContext {
  const StudySimulator& simulator;
  const RunStore& folder;
  Executor& executor;
  const std::atomic<bool>& is_interrupted;
  std::function<void(const StudyProgress&)> report = [](const StudyProgress&) {};
  /// Is handed what is known when it is interrupted, where that is enough for a fit.
  std::function<void(const ProvisionalOutcome&)> leave = {};
};

/// About how long a job takes, s by the program's own measure.
double run_s_of(const Problem& problem, const Job& job);

/// Gets jobs done: from the folder where they are there, else by the executor.
class JobRunner {
 public:
  JobRunner(const Problem& problem, const StudyContext& context)
      : problem_(problem), context_(context) {}

  /// In the order of the jobs. None when it was interrupted. `later_s` is the work of the stages
  /// that follow, for those who watch.
  /// @throws base::InputError  a protocol that cannot be run, a folder that cannot be written.
  std::optional<std::vector<Run>> get(const std::string& stage, const std::vector<Job>& jobs,
                                      std::optional<double> later_s = {});

  /// What those who watch are told of the rounds from now on.
  void tell(std::vector<RoundSummary> rounds) { rounds_ = std::move(rounds); }

  /// The last that was begun.
  const std::string& stage() const { return stage_; }
  int reused() const { return reused_; }
  int simulated() const { return simulated_; }

 private:
  void simulate(StudyProgress progress, const std::vector<Job>& jobs,
                const std::vector<std::size_t>& open, std::vector<std::optional<Run>>& runs);
  /// What a fit takes from it. Readings that cannot be make it a failed run, and are noted.
  Run possible(const Job& job, RunResult result) const;
  void keep(const Job& job, const RunResult& result) const;

  const Problem& problem_;
  const StudyContext& context_;
  std::vector<RoundSummary> rounds_;
  std::string stage_;
  int reused_ = 0;
  int simulated_ = 0;
};

/// By a definition's name, in the order of base/angle_definition.h.
using NamedAngles = std::vector<std::pair<std::string, double>>;

/// Mean over the heaps among the runs, as the folder holds them, by the definitions that all of
/// them allow. Empty: there are no heaps.
NamedAngles heap_angles_deg(const StudyContext& context, const std::vector<Run>& runs);

}  // namespace repose::calibrate
