#pragma once

#include <vector>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// The jobs to run next; empty when the fit has settled or the budget is spent.
///
/// Jobs come in rounds, each planned from the complete rounds before it. While runs of a round are
/// missing, these are returned: ask again after any number of them, in any order, after an
/// interruption, with any number of workers; the study is the same. A failed run counts as done.
/// Runs that were never proposed are ignored here. Throws base::InputError with every error of the
/// problem, and when fewer than three runs of an experiment have the reading.
std::vector<Job> propose(const Problem& problem, const std::vector<Run>& completed);

}  // namespace repose::calibrate
