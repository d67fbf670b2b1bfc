#include "cli/simulate/simulate_values.h"

#include <algorithm>
#include <cmath>

namespace repose::cli {
namespace {

bool is_well_pictured(const Run& run) {
  return run.outcome == RunOutcome::done && run.pictures &&
         calibrate::is_well_pictured(run.pictures->views);
}

}  // namespace

bool is_from_pictures(const std::vector<Run>& runs) {
  return !runs.empty() && std::all_of(runs.begin(), runs.end(), is_well_pictured);
}

std::vector<double> values_of(const std::vector<Run>& runs) {
  const bool is_pictured = is_from_pictures(runs);
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) {
    values.push_back(is_pictured ? calibrate::angle_deg(run.pictures->views)->mean
                                 : run.repeat.value);
  }
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
    if (!run.pictures || run.pictures->views.empty()) return std::nullopt;
    positions.push_back(run.repeat.value);
    const auto scatter = run.repeat.readings.find("between_views_deg");
    if (scatter != run.repeat.readings.end()) angles.between_views_positions += scatter->second;
    angles.views += static_cast<int>(run.pictures->views.size());
    angles.refused += count(run.pictures->views, vision::MeasureStatus::refused);
    angles.flagged += count(run.pictures->views, vision::MeasureStatus::flagged);
    const auto seen = calibrate::angle_deg(run.pictures->views);
    if (seen) pictures.push_back(seen->mean);
    if (seen && seen->sd) scatters.push_back(*seen->sd);
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
