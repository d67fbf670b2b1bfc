#pragma once

#include <string>

#include "dem/experiment/draw_down.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"

/// Walls as text STL files, in metres: for programs whose walls are meshes.
namespace repose::calibrate {

/// The incline of a roll test: one triangle, so that no inner edge lies on the grain's path. Its
/// foot is the y axis.
std::string incline_stl(const dem::RollProtocol& protocol, double reach_m);

/// A heap's tube with this number of flat sides, standing on z = 0; and its plate below.
std::string tube_stl(const dem::HeapProtocol& protocol, int sides);
std::string plate_stl(const dem::HeapProtocol& protocol);

/// The floor of a draw-down's upper box, and the gate that closes its slot: sheets at the height of
/// the floor's upper side.
std::string slotted_floor_stl(const dem::DrawDownProtocol& protocol);
std::string gate_stl(const dem::DrawDownProtocol& protocol);

}  // namespace repose::calibrate
