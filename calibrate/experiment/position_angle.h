#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "dem/experiment/experiment.h"
#include "dem/experiment/heap_envelope.h"
#include "vision/measure/outline_angle.h"

/// The angle of a simulated heap from the places of its grains, by the line that pictures are
/// measured with.
namespace repose::calibrate {

/// All empty where less than half of the flanks could be fitted, two a view: the grains still stand
/// as they stood in the tube, or lie in a layer. The few that lean then say nothing of a heap.
struct PositionAngle {
  std::optional<double> angle_deg;          ///< mean of the views that have a flank
  std::optional<double> between_views_deg;  ///< standard deviation; none of a single view
  std::optional<double> first_view_deg;     ///< of the first view alone; none without a flank
  std::optional<double> base_radius_m;  ///< from the crest to where the lines meet the ground; mean
  int flanks = 0;                       ///< how many there were to fit
  /// By the other definitions of base/angle_definition.h, by name: the mean of the views, where at
  /// least half of them allow it. Only if options.has_definitions.
  std::map<std::string, double> other_deg;
};

/// A view's angle is the mean of its flanks'. Without `options.grain` it is as a silhouette of the
/// same view is measured: of 26 views of 8 simulated heaps 23 lay within .11 degrees, the worst 2.4
/// off. A silhouette does not show its grains either: with their known size 19 did, the worst 3.5
/// off.
/// @throws base::InputError  as vision::measure_outline().
PositionAngle position_angle(std::span<const dem::HeapEnvelope> envelopes,
                             const vision::OutlineOptions& options = {});

/// Completes what run_heap() or resume_heap() returned: takes its envelopes, sets its value to
/// their angle in degrees, and adds the readings "base_radius_mm", "between_views_deg" (scatter
/// between directions), "angle_xz_deg" (seen along y) and "inner_window_deg" (as the value, but
/// fitted from 30 to 70 % of the height instead of 20 to 80: low heaps are hollow at the foot, and
/// the stretch moves their angle). NaN where there is none: of a layer ("no_heap" 1) all of them
/// are. Returns the same angle by the other definitions, as PositionAngle::other_deg.
std::map<std::string, double> add_position_angle(dem::Repeat& heap);

}  // namespace repose::calibrate
