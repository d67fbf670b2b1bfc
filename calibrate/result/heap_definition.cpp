#include <cmath>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "calibrate/result/result.h"

namespace repose::calibrate {

std::string text_of(const HeapDefinition& definition) {
  const base::AngleDefinition* known = base::find_definition(definition.name);
  return fmt::format("{} ({}){}", definition.name,
                     known != nullptr ? known->description : "unknown to this version",
                     definition.is_assumed ? ", which is assumed: the study does not say" : "");
}

std::string simulated_text(const HeapDefinition& definition) {
  double used_deg = NAN;
  for (const auto& [name, angle_deg] : definition.simulated_deg) {
    if (name == definition.name) used_deg = angle_deg;
  }
  if (!std::isfinite(used_deg)) return {};
  std::string others;
  for (const auto& [name, angle_deg] : definition.simulated_deg) {
    if (name == definition.name) continue;
    others +=
        fmt::format("{}{} {:+.2f}", others.empty() ? "; by " : ", ", name, angle_deg - used_deg);
  }
  return fmt::format("{:.2f} degrees by it{}", used_deg, others);
}

}  // namespace repose::calibrate
