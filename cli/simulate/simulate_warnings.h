#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/simulate/simulate_runs.h"

namespace repose::cli {

/// A value that a person must look at before using it.
struct RunWarning {
  std::string code;                   ///< fixed word
  std::optional<std::uint64_t> seed;  ///< none: of all repeats together
  std::string message;                ///< sentence
};

/// What the readings of finished repeats tell against their values.
std::vector<RunWarning> warnings_of(const SimulatePlan& plan, const std::vector<Run>& runs);

}  // namespace repose::cli
