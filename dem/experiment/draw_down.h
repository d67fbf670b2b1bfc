#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"

namespace repose::dem {

/// The wall that is taken away to open the slot.
inline constexpr int kDrawDownGate = 7;

/// Both boxes, the upper one filled and struck level, the gate shut. Throws base::InputError
/// for a protocol that cannot be run (every error at once).
ExperimentRun filled_boxes(const Model& model, const DrawDownProtocol& protocol, std::uint64_t seed,
                           const Observers& observers);

}  // namespace repose::dem
