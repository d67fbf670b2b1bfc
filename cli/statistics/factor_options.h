#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/design/factor.h"

namespace repose::cli {

/// "NAME=MIN:MAX"; a fault when it is not.
std::optional<calibrate::Factor> factor_in(const std::string& option, const std::string& text,
                                           std::vector<std::string>& faults);

/// "NAME=NUMBER"; a fault when it is not.
std::optional<std::pair<std::string, double>> named_number_in(const std::string& option,
                                                              const std::string& text,
                                                              std::vector<std::string>& faults);

}  // namespace repose::cli
