#include "cli/compare/angle_cells.h"

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/table.h"

namespace repose::cli {

std::string angle_cell(const std::optional<double>& angle_rad,
                       const std::optional<double>& uncertainty_rad) {
  if (!angle_rad) return kNothing;
  if (!uncertainty_rad) return fmt::format("{:.2f}", to_degrees(*angle_rad));
  return fmt::format("{:.2f} ± {:.2f}", to_degrees(*angle_rad), to_degrees(*uncertainty_rad));
}

std::string difference_cell(const std::optional<vision::AngleDifference>& angle) {
  if (!angle) return kNothing;
  return angle_cell(angle->difference_rad, (angle->interval_rad[1] - angle->interval_rad[0]) / 2);
}

}  // namespace repose::cli
