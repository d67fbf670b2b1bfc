#pragma once

#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// For people: each repeat, their mean, the other readings, what the bench gave, and what the
/// numbers belong to.
std::string simulate_table(const SimulatePlan& plan, const std::vector<Run>& runs, int columns);

}  // namespace repose::cli
