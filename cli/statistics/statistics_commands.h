#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/statistics/factor.h"
#include "cli/common/command.h"

namespace repose::cli {

/// Parses "NAME=MIN:MAX"; adds an error if invalid.
std::optional<calibrate::Factor> factor_in(const std::string& option, const std::string& text,
                                           std::vector<std::string>& errors);

/// Parses "NAME=NUMBER"; adds an error if invalid.
std::optional<std::pair<std::string, double>> named_number_in(const std::string& option,
                                                              const std::string& text,
                                                              std::vector<std::string>& errors);

Command bench_command();
Command design_command();
Command regress_command();

}  // namespace repose::cli
