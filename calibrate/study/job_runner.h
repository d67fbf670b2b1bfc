#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/study_context.h"

namespace repose::calibrate {

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

  int reused() const { return reused_; }
  int simulated() const { return simulated_; }

 private:
  void simulate(StudyProgress progress, const std::vector<Job>& jobs,
                const std::vector<std::size_t>& open, std::vector<std::optional<Run>>& runs);
  /// What a fit takes from it. Readings that cannot be make it a failed run, and are noted.
  Run possible(const SimulatedJob& done) const;
  void keep(const SimulatedJob& done) const;

  const Problem& problem_;
  const StudyContext& context_;
  int reused_ = 0;
  int simulated_ = 0;
};

}  // namespace repose::calibrate
