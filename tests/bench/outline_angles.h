#pragma once

#include "render/truth.h"
#include "tests/bench/subject.h"

namespace repose::bench {

/// Flanks of an exact outline over 20 to 80 % of its height above the exact ground, by the line
/// that a measurement fits to the edge it sees: what it would find if it saw without error.
FlankAngles outline_angles(const render::Truth& truth, double grain_px);

}  // namespace repose::bench
