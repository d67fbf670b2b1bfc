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

/// How a study's jobs are done, with any method.
namespace repose::calibrate {

/// Progress of a study.
struct StudyProgress {
  std::string stage;  ///< "round 2 of at most 4", "check 1 of at most 3"
  int done = 0;       ///< jobs of this stage
  int of = 0;
  double seconds_done = 0;  ///< estimated work of those, core seconds
  double seconds_of = 0;
  std::optional<double> seconds_later;    ///< of the stages that follow, at most; or unknown
  std::vector<RoundSummary> rounds = {};  ///< of the fit's completed rounds
};

/// What is known of an interrupted study: an unchecked fit to the completed rounds.
struct ProvisionalOutcome {
  std::string stage;  ///< during which it was interrupted
  JointFit fit;
  std::vector<Run> runs;  ///< used for the fit
};

/// What a study needs to run its jobs. All of it must outlive the study.
struct StudyContext {
  const StudySimulator& simulator;
  const RunStore& folder;
  Executor& executor;
  const std::atomic<bool>& is_interrupted;
  std::function<void(const StudyProgress&)> report = [](const StudyProgress&) {};
  /// Receives what is known on interruption, if that is enough for a fit.
  std::function<void(const ProvisionalOutcome&)> leave = {};
};

/// Approximate duration of a job, s by the program's own measure.
double run_s_of(const Problem& problem, const Job& job);

/// Gets results of jobs: from the folder if they are there, otherwise from the executor.
class JobRunner {
 public:
  JobRunner(const Problem& problem, const StudyContext& context)
      : problem_(problem), context_(context) {}

  /// In the order of the jobs. std::nullopt if interrupted. `later_s` is the work of the following
  /// stages, for progress reports.
  /// @throws base::InputError  a protocol that cannot be run, a folder that cannot be written.
  std::optional<std::vector<Run>> get(const std::string& stage, const std::vector<Job>& jobs,
                                      std::optional<double> later_s = {});

  /// Sets the rounds given in progress reports from now on.
  void tell(std::vector<RoundSummary> rounds) { rounds_ = std::move(rounds); }

  /// The stage started last.
  const std::string& stage() const { return stage_; }
  int reused() const { return reused_; }
  int simulated() const { return simulated_; }

 private:
  void simulate(StudyProgress progress, const std::vector<Job>& jobs,
                const std::vector<std::size_t>& open, std::vector<std::optional<Run>>& runs);
  /// The run for the fit. Impossible readings make it a failed run, and are noted.
  Run possible(const Job& job, RunResult result) const;
  void keep(const Job& job, const RunResult& result) const;

  const Problem& problem_;
  const StudyContext& context_;
  std::vector<RoundSummary> rounds_;
  std::string stage_;
  int reused_ = 0;
  int simulated_ = 0;
};

/// By the name of the definition, in the order of base/angle_definition.h.
using NamedAngles = std::vector<std::pair<std::string, double>>;

/// Mean over the saved heaps of these runs, by the definitions available for all of them. Empty:
/// there are no heaps.
NamedAngles heap_angles_deg(const StudyContext& context, const std::vector<Run>& runs);

}  // namespace repose::calibrate
