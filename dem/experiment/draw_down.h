#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"

namespace repose::dem {

class ExperimentRun;
struct Observers;

/// Grains that run out of one box, through a slot in its floor, into another below it.
///
/// Both boxes are `length_m` long (x) and `depth_m` deep (y) inside, with upright walls; the slot
/// is in the middle and as deep as the boxes. The grains rain into the upper box and are struck
/// level: those whose centres of mass lie higher than the fill go. Then the slot opens at once.
/// Value: what has run out when all grains rest again, % of the fill. Readings: "filled_g",
/// "discharged_g", "time_s" (from the opening until 95 % of what runs out is below the slot: the
/// last grains trickle), "rate_g_s" (mean from 10 to 50 % of it, while the flow is steady),
/// "grains", "grains_out", "at_rest" (0: still creeping 5 s after the last grain ran out). The
/// angles of the two slopes that stay and of the heap below are measured in pictures of its state.
/// Throws NoMeasurement when no grains run out, when so many do that no slope stays (nothing, or a
/// single layer), when they arch over the slot, or when the lower heap reaches it.
struct DrawDownProtocol {
  double length_m = .5;
  double depth_m = .15;
  double slot_m = .12;
  double fill_m = .15;  ///< height of the grains in the upper box
  double drop_m = .25;  ///< from the slot's lower edge to the floor of the lower box
};

Repeat run_draw_down(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                     const ProgressReport& report = {}, const RunRecord& record = {});

/// What the grains in the upper box lie on, m above the lower box's floor.
double upper_floor_m(const DrawDownProtocol& protocol);
/// What a picture of its slopes is taken by.
BoxesFront front_of(const DrawDownProtocol& protocol);

/// The wall that is taken away to open the slot.
inline constexpr int kDrawDownGate = 7;

/// Both boxes, the upper one filled and struck level, the gate shut. Throws base::InputError
/// for a protocol that cannot be run (every error at once).
ExperimentRun filled_boxes(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                           const Observers& observers);

}  // namespace repose::dem
