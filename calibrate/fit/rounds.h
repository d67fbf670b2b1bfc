#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Points that fill each experiment's own parameters evenly; if stochastic, every fifth twice, to
/// estimate the effect of the seed.
std::vector<Job> first_round(const Problem& problem);

// A study's first round has two parts if some experiments follow others: expensive ones that depend
// on all that a cheap one depends on and on more besides. See THEORY.md, "Rounds".

bool has_followers(const Problem& problem);

/// First-round jobs of the experiments that follow no other.
std::vector<Job> leading_jobs(const Problem& problem);

/// Of the others: as many as in the first round, where the leading runs leave their parameters
/// plausible; one in eight anywhere.
std::vector<Job> following_jobs(const Problem& problem, const std::vector<Run>& leading);

/// The rounds of a study, as far as its runs go.
struct Rounds {
  std::vector<RoundSummary> complete;
  std::vector<Job> missing;  ///< of the incomplete round; empty: the study has ended
};

/// Replans the study from the beginning: the first round from the problem, each later one from the
/// runs of those before it. So the rounds depend only on the results of the runs.
Rounds reconstruct_rounds(const Problem& problem, const std::vector<Run>& runs);

}  // namespace repose::calibrate
