#pragma once

#include <optional>
#include <string>

#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// An angle and the half-width of its interval, in degrees, as tables show them.
std::string angle_cell(const std::optional<double>& angle_rad,
                       const std::optional<double>& uncertainty_rad);

std::string difference_cell(const std::optional<vision::AngleDifference>& angle);

}  // namespace repose::cli
