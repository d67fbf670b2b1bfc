#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"

namespace repose::dem {

class ExperimentRun;
struct Observers;

/// Grains that flow out of a box, through a slot in its floor, into another below.
///
/// Both boxes are `length_m` long (x) and `depth_m` deep (y) inside, with upright walls; the slot
/// is in the middle and as deep as the boxes. The grains rain into the upper box and are struck
/// level: those whose centres of mass lie above the fill height are removed. Then the slot opens
/// instantly. Value: what has run out when all grains rest again, % of the fill. Readings:
/// "filled_g", "discharged_g", "time_s" (from the opening until 95 % of the discharge is below the
/// slot; the last grains trickle), "rate_g_s" (mean from 10 to 50 % of it, while the flow is
/// steady), "grains", "grains_out", "at_rest" (0: still creeping 5 s after the last grain ran out).
/// The angles of the two remaining slopes and of the heap below are measured in images of the final
/// state. Throws NoMeasurement if no grains run out, if so many do that no slope remains (nothing,
/// or a single layer), if they arch over the slot, or if the lower heap reaches it.
struct DrawDownProtocol {
  double length_m = .5;
  double depth_m = .15;
  double slot_m = .12;
  double fill_m = .15;  ///< height of the grains in the upper box
  double drop_m = .25;  ///< from the slot's lower edge to the floor of the lower box
};

Repeat run_draw_down(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                     const ProgressReport& report = {}, const RunRecord& record = {});

/// Floor of the upper box, m above the lower box's floor.
double upper_floor_m(const DrawDownProtocol& protocol);
/// Geometry for images of its slopes.
BoxesFront front_of(const DrawDownProtocol& protocol);

/// The wall that is removed to open the slot.
inline constexpr int kDrawDownGate = 7;

/// Both boxes, the upper one filled and struck level, the gate shut. Throws base::InputError for an
/// invalid protocol (all errors at once).
ExperimentRun filled_boxes(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                           const Observers& observers);

}  // namespace repose::dem
