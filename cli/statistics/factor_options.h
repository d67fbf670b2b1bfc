#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/statistics/factor.h"

namespace repose::cli {

/// "NAME=MIN:MAX"; an error when it is not.
std::optional<calibrate::Factor> factor_in(const std::string& option, const std::string& text,
                                           std::vector<std::string>& errors);

/// "NAME=NUMBER"; an error when it is not.
std::optional<std::pair<std::string, double>> named_number_in(const std::string& option,
                                                              const std::string& text,
                                                              std::vector<std::string>& errors);

}  // namespace repose::cli
