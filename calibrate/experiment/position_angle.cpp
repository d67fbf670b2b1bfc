#include "calibrate/experiment/position_angle.h"

#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

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
  for (const dem::HeapEnvelope& envelope : envelopes) {
    const vision::OutlineAngle view = vision::measure_outline(outline_of(envelope), options);
    const auto angle_rad = view.angle_rad();
    if (!angle_rad) continue;
    angles.push_back(*angle_rad * 180 / std::numbers::pi);
    if (&envelope == &envelopes.front()) result.first_view_deg = angles.back();
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
  if (angles.empty()) return result;
  const Summary views = summarise(angles);
  result.angle_deg = views.mean;
  result.between_views_deg = views.sd.value_or(0);
  result.base_radius_m = summarise(feet).mean;
  return result;
}

void add_position_angle(dem::Repeat& heap) {
  const std::vector<dem::HeapEnvelope> envelopes = std::exchange(heap.envelopes, {});
  const PositionAngle usual = position_angle(envelopes);
  const PositionAngle inner = position_angle(envelopes, {.window_from = .3, .window_to = .7});
  heap.value = usual.angle_deg;
  heap.readings["base_radius_mm"] = 1e3 * usual.base_radius_m;
  heap.readings["between_views_deg"] = usual.between_views_deg;
  heap.readings["angle_xz_deg"] = usual.first_view_deg;
  heap.readings["inner_window_deg"] = inner.angle_deg;
}

}  // namespace repose::calibrate
