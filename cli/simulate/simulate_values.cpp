#include "cli/simulate/simulate_values.h"

#include <algorithm>
#include <cmath>

namespace repose::cli {
std::string source_of(const std::vector<Run>& runs) {
  const auto pictured = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return calibrate::is_from_pictures(run.result);
  });
  if (pictured == 0) return "positions";
  return pictured == static_cast<std::ptrdiff_t>(runs.size()) ? "pictures" : "mixed";
}

std::vector<double> values_of(const std::vector<Run>& runs) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) values.push_back(calibrate::value_of(run.result));
  return values;
}

std::optional<calibrate::Summary> summarise(const std::vector<Run>& runs) {
  const std::vector<double> values = values_of(runs);
  const auto is_number = [](double value) { return std::isfinite(value); };
  const auto is_done = [](const Run& run) { return run.outcome == RunOutcome::done; };
  if (values.empty() || !std::all_of(runs.begin(), runs.end(), is_done) ||
      !std::all_of(values.begin(), values.end(), is_number)) {
    return std::nullopt;
  }
  calibrate::Summary repeats = calibrate::summarise(values);
  if (std::equal(values.begin() + 1, values.end(), values.begin())) {
    repeats.sd.reset();
    repeats.mean_uncertainty.reset();
  }
  return repeats;
}

std::optional<HeapAngles> heap_angles(const std::vector<Run>& runs) {
  HeapAngles angles;
  std::vector<double> positions, pictures, scatters;
  for (const Run& run : runs) {
    const calibrate::SimulatedRun& result = run.result;
    if (result.views.empty()) return std::nullopt;
    positions.push_back(result.value);
    const auto scatter = result.readings.find("between_views_deg");
    if (scatter != result.readings.end()) angles.between_views_positions += scatter->second;
    const calibrate::PictureMean seen = calibrate::mean_of_views(result.views);
    angles.views += static_cast<int>(result.views.size());
    angles.refused += seen.refused;
    angles.flagged += seen.flagged;
    angles.pictured += calibrate::is_from_pictures(result) ? 1 : 0;
    if (seen.angle_deg) pictures.push_back(seen.angle_deg->mean);
    if (seen.angle_deg && seen.angle_deg->sd) scatters.push_back(*seen.angle_deg->sd);
  }
  if (positions.empty()) return std::nullopt;
  angles.positions = calibrate::summarise(positions);
  angles.between_views_positions /= static_cast<double>(runs.size());
  if (pictures.size() == runs.size()) angles.pictures = calibrate::summarise(pictures);
  if (scatters.size() == runs.size()) {
    angles.between_views_pictures = calibrate::summarise(scatters).mean;
  }
  return angles;
}

}  // namespace repose::cli
