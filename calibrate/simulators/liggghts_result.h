#pragma once

#include <cstdint>
#include <filesystem>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/export/facts.h"
#include "dem/experiment/experiment.h"

namespace repose::calibrate {

/// The result of a LIGGGHTS run, read back from the folder in which its deck, made from these
/// facts, has run. Proved by LostGrains.* in tests/calibrate and LiggghtsSimulator.* in
/// tests/peers.
/// @throws dem::NoMeasurement  the measured event did not happen, or grains were lost.
/// @throws base::InputError  the folder's content is not as expected.
dem::Repeat liggghts_result(const RunSpec& spec, const ExportFacts& facts, std::uint64_t seed,
                            const std::filesystem::path& folder);

}  // namespace repose::calibrate
