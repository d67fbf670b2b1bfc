#include "calibrate/experiment/position_angle.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/units.h"
#include "calibrate/statistics/summary.h"

namespace repose::calibrate {
namespace {

vision::Outline outline_of(const dem::HeapEnvelope& envelope) {
  vision::Outline outline{.along = {}, .height = envelope.height_m};
  for (std::size_t k = 0; k < envelope.height_m.size(); ++k) {
    outline.along.push_back(static_cast<double>(k) * envelope.column_m);
  }
  return outline;
}

}  // namespace

PositionAngle position_angle(std::span<const dem::HeapEnvelope> envelopes,
                             const vision::OutlineOptions& options) {
  PositionAngle result;
  std::vector<double> angles;
  std::vector<double> feet;
  std::optional<double> first_view_deg;
  std::map<std::string, std::vector<double>> others;
  for (const dem::HeapEnvelope& envelope : envelopes) {
    const vision::OutlineAngle view = vision::measure_outline(outline_of(envelope), options);
    const auto angle_rad = view.angle_rad();
    if (!angle_rad) continue;
    angles.push_back(to_degrees(*angle_rad));
    for (const vision::NamedAngle& other : view.definitions) {
      others[other.name].push_back(to_degrees(other.angle_rad));
    }
    if (&envelope == &envelopes.front()) first_view_deg = angles.back();
    double foot = 0;
    int sides = 0;
    for (const auto& flank : {view.left, view.right}) {
      if (!flank) continue;
      foot += flank->foot;
      ++sides;
    }
    feet.push_back(foot / sides);
    result.flanks += sides;
  }
  if (angles.empty() || result.flanks < static_cast<int>(envelopes.size())) return result;
  const Summary views = summarise(angles);
  result.angle_deg = views.mean;
  result.between_views_deg = views.sd;
  result.first_view_deg = first_view_deg;
  result.base_radius_m = summarise(feet).mean;
  for (const auto& [name, of_views] : others) {
    if (2 * of_views.size() >= envelopes.size()) result.other_deg[name] = summarise(of_views).mean;
  }
  return result;
}

std::map<std::string, double> add_position_angle(dem::Repeat& heap) {
  const std::vector<dem::HeapEnvelope> envelopes = std::exchange(heap.envelopes, {});
  const auto layer = heap.readings.find("no_heap");
  const bool is_layer = layer != heap.readings.end() && layer->second != 0;
  const PositionAngle usual =
      is_layer ? PositionAngle{} : position_angle(envelopes, {.has_definitions = true});
  PositionAngle inner;
  if (usual.angle_deg) inner = position_angle(envelopes, {.window_from = .3, .window_to = .7});
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  heap.value = usual.angle_deg.value_or(kNone);
  heap.readings["base_radius_mm"] = 1e3 * usual.base_radius_m.value_or(kNone);
  heap.readings["between_views_deg"] = usual.between_views_deg.value_or(kNone);
  heap.readings["angle_xz_deg"] = usual.first_view_deg.value_or(kNone);
  heap.readings["inner_window_deg"] = inner.angle_deg.value_or(kNone);
  return usual.other_deg;
}

}  // namespace repose::calibrate
