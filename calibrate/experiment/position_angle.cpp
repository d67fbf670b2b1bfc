#include "calibrate/experiment/position_angle.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
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

vision::OutlineAngle angle_of(const dem::HeapEnvelope& envelope) {
  if (envelope.height_m.empty()) return {};
  return vision::measure_outline(outline_of(envelope));
}

/// Of the sides that have one, in degrees; NaN without any.
double mean_deg(const std::optional<vision::OutlineFlank>& left,
                const std::optional<vision::OutlineFlank>& right) {
  const auto angle_rad = vision::OutlineAngle{.left = left, .right = right}.angle_rad();
  return angle_rad.value_or(std::numeric_limits<double>::quiet_NaN()) * 180 / std::numbers::pi;
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

void add_draw_down_angles(dem::Repeat& draw_down) {
  const dem::DrawDownOutlines outlines = *std::exchange(draw_down.draw_down, {});
  const vision::OutlineAngle lower = angle_of(outlines.lower);
  draw_down.readings["lower_angle_deg"] = mean_deg(lower.left, lower.right);
  draw_down.readings["upper_angle_deg"] =
      mean_deg(angle_of(outlines.upper_right).left, angle_of(outlines.upper_left).right);
}

}  // namespace repose::calibrate
