#include "cli/simulate/simulate_values.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/angle_definition.h"

namespace repose::cli {
std::string source_of(const std::vector<Run>& runs) {
  const auto pictured = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return calibrate::is_from_pictures(run.result);
  });
  if (pictured == 0) return "positions";
  return pictured == static_cast<std::ptrdiff_t>(runs.size()) ? "pictures" : "mixed";
}

std::optional<std::vector<double>> values_of(const std::vector<Run>& runs) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) {
    const auto value = calibrate::value_of(run.result);
    if (run.outcome != RunOutcome::done || !value || !std::isfinite(*value)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<double> readings_named(const std::vector<Run>& runs, const std::string& name) {
  std::vector<double> readings;
  for (const Run& run : runs) {
    if (const auto reading = run.result.readings.number(name)) readings.push_back(*reading);
  }
  return readings;
}

std::vector<std::pair<std::string, double>> means_by_definition(const std::vector<Run>& runs) {
  std::map<std::string, std::vector<double>> angles;
  for (const Run& run : runs) {
    for (const auto& [name, angle] : calibrate::values_by_definition(run.result)) {
      angles[name].push_back(angle);
    }
  }
  std::vector<std::pair<std::string, double>> means;
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    const auto found = angles.find(std::string(definition.name));
    if (found == angles.end() || found->second.size() < runs.size()) continue;
    means.emplace_back(definition.name, calibrate::summarise(found->second).mean);
  }
  return means;
}

std::optional<calibrate::Summary> summarise(const std::vector<Run>& runs) {
  const std::optional<std::vector<double>> values = values_of(runs);
  if (!values || values->empty()) return std::nullopt;
  calibrate::Summary repeats = calibrate::summarise(*values);
  if (std::equal(values->begin() + 1, values->end(), values->begin())) {
    repeats.sd.reset();
    repeats.mean_uncertainty.reset();
  }
  return repeats;
}

std::optional<HeapAngles> heap_angles(const std::vector<Run>& runs) {
  if (runs.empty() || !values_of(runs)) return std::nullopt;
  HeapAngles angles;
  std::vector<double> positions, pictures, scatters;
  for (const Run& run : runs) {
    const calibrate::RunResult& result = run.result;
    if (result.views.empty()) return std::nullopt;
    if (const auto angle = calibrate::position_value(result)) positions.push_back(*angle);
    const calibrate::PictureMean seen = calibrate::picture_mean(result);
    angles.views += static_cast<int>(result.views.size());
    angles.refused += seen.refused;
    angles.flagged += seen.flagged;
    angles.pictured += calibrate::is_from_pictures(result) ? 1 : 0;
    if (seen.angle_deg) pictures.push_back(seen.angle_deg->mean);
    if (seen.angle_deg && seen.angle_deg->sd) scatters.push_back(*seen.angle_deg->sd);
  }
  const auto of_all = [&](const std::vector<double>& numbers) {
    return numbers.size() == runs.size() ? std::optional(calibrate::summarise(numbers))
                                         : std::nullopt;
  };
  const auto mean_of_all = [&](const std::vector<double>& numbers) {
    const auto summary = of_all(numbers);
    return summary ? std::optional(summary->mean) : std::nullopt;
  };
  angles.positions = of_all(positions);
  angles.pictures = of_all(pictures);
  // The reading is of the usual definition.
  if (base::is_usual_definition(runs.front().result.definition)) {
    angles.between_views_positions = mean_of_all(readings_named(runs, "between_views_deg"));
  }
  angles.between_views_pictures = mean_of_all(scatters);
  return angles;
}

}  // namespace repose::cli
