#pragma once

#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// The result, as a JSON object.
std::string simulate_json(const SimulatePlan& plan, const Repeats& repeats);

/// For people: each repeat, their mean, the other readings, the bench's result, and the conditions
/// of the simulation.
std::string simulate_table(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs,
                           int columns);

}  // namespace repose::cli
