#pragma once

#include <optional>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"

namespace repose::dem {

/// The walls of the heap experiment, in this order.
inline constexpr int kHeapPlate = 0;
inline constexpr int kHeapTube = 1;

/// Of a tube that it rains or is poured into, until the heap lies.
Pace pace_of_rain(const Model& model, std::optional<double> spout_m = {});

/// The tube on its plate, made taller to be heaped over, and empty.
///
/// Grains rain into it, or fall from a spout: its height over the plate, m.
ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m = {});

/// Pours grains into it until they are heaped over its rim, `protocol.tube_height_m`, and rest.
/// `filling` is empty, or was interrupted while it was filled.
void pour(ExperimentRun& filling, const HeapProtocol& protocol, std::uint64_t seed,
          std::optional<double> spout_m = {}, std::optional<double> grains_per_s = {});

/// The tube with what lies below its rim, its time set back to 0: grains whose centres lie higher
/// are off.
ExperimentRun struck_level(const ExperimentRun& filling, const Model& model,
                           const HeapProtocol& protocol, std::optional<double> spout_m = {});

/// The tube, full of grains at rest, its time set back to 0: poured and struck level.
///
/// Throws base::InputError when `protocol.grains` are more than fit.
ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed);

}  // namespace repose::dem
