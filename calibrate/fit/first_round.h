#pragma once

#include <vector>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Points that fill each experiment's own parameters evenly; with chance, every fifth twice, to
/// learn how much the seed does.
std::vector<Job> first_round(const Problem& problem);

// A study's first round comes in two parts, where some experiments follow others: those that cost
// much, and depend on all that a cheap one depends on and on more besides. See THEORY.md, "Rounds".

bool has_followers(const Problem& problem);

/// Of the experiments that follow none: their jobs of the first round.
std::vector<Job> leading_jobs(const Problem& problem);

/// Of the others: as many as in the first round, where those before leave their parameters
/// plausible; one in eight anywhere.
std::vector<Job> following_jobs(const Problem& problem, const std::vector<Run>& leading);

}  // namespace repose::calibrate
