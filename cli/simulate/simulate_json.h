#pragma once

#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// The result, as a JSON object.
std::string simulate_json(const SimulatePlan& plan, const std::vector<Run>& runs);

}  // namespace repose::cli
