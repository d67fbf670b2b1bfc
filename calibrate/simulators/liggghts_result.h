#pragma once

#include <cstdint>
#include <filesystem>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/export/facts.h"
#include "dem/experiment/experiment.h"

namespace repose::calibrate {

/// What a run of LIGGGHTS's gives: read back from the folder in which its deck, made of these
/// facts, ended. Proved by LostGrains.* in tests/calibrate and LiggghtsSimulator.* in tests/peers.
/// @throws dem::NoMeasurement  what is measured did not happen, or grains were lost.
/// @throws base::InputError  the folder has something else.
dem::Repeat liggghts_result(const RunSpec& spec, const ExportFacts& facts, std::uint64_t seed,
                            const std::filesystem::path& folder);

}  // namespace repose::calibrate
