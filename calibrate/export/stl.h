#pragma once

#include <string>

#include "dem/experiment/draw_down.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"

/// Walls as STL files in text form, in metres: for programs whose walls are meshes.
namespace repose::calibrate {

/// The incline of a roll test: one triangle, so that no inner edge lies on the way. Its foot is the
/// y axis.
std::string incline_stl(const dem::RollProtocol& protocol, double reach_m);

/// A heap's tube, standing on z = 0, of so many flat sides, and its plate below.
std::string tube_stl(const dem::HeapProtocol& protocol, int sides);
std::string plate_stl(const dem::HeapProtocol& protocol);

/// What the grains in the upper box of a draw-down lie on, and the gate that shuts its slot: sheets
/// as high as its upper side.
std::string slotted_floor_stl(const dem::DrawDownProtocol& protocol);
std::string gate_stl(const dem::DrawDownProtocol& protocol);

}  // namespace repose::calibrate
