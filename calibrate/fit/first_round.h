#pragma once

#include <vector>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Points that fill each experiment's own parameters evenly; with chance, every fifth twice, to
/// learn how much the seed does.
std::vector<Job> first_round(const Problem& problem);

}  // namespace repose::calibrate
