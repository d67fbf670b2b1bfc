#pragma once

#include <string>

#include "calibrate/simulators/liggghts_scene.h"
#include "tests/support/run_program.h"

/// LIGGGHTS-PUBLIC 3.8, Debian package `liggghts`, on decks of our scenes.
namespace repose::testing {

inline constexpr const char* kNoLiggghts =
    "liggghts is not installed; nothing was compared. Fix: apt-get install liggghts";

bool has_liggghts();

/// Throws std::runtime_error with the end of its output if it fails.
Finished run_liggghts(const TemporaryFolder& folder, const std::string& deck);

}  // namespace repose::testing
