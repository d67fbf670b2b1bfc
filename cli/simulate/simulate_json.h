#pragma once

#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// What a state belongs to: experiment, seed, study, contact model, clump, time step, program.
std::string provenance_json(const SimulatePlan& plan, std::uint64_t seed);

/// The result, as a JSON object.
std::string simulate_json(const SimulatePlan& plan, const std::vector<Run>& runs);

}  // namespace repose::cli
