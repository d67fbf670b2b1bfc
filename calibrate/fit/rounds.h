#pragma once

#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// The rounds of a study, as far as its runs go.
struct Rounds {
  std::vector<RoundSummary> complete;
  std::vector<Job> missing;  ///< of the round that is not complete; empty: the study has ended
};

/// Plans the study again from the beginning: the first round from the problem, each later one from
/// the runs of those before it. So the rounds depend on what the runs gave and on nothing else.
Rounds replay(const Problem& problem, const std::vector<Run>& runs);

}  // namespace repose::calibrate
