#pragma once

#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// The result, as a JSON object.
std::string simulate_json(const SimulatePlan& plan, const std::vector<Run>& runs);

/// The contact model in a few words.
std::string contact_model_text();
/// How the torque of rolling friction is defined.
std::string rolling_definition(dem::RollingModel model);

}  // namespace repose::cli
