#pragma once

#include "render/truth.h"
#include "tests/bench/subject.h"

namespace repose::bench {

/// Flanks of an exact outline over 20 to 80 % of its height above the exact ground, by the line
/// that a measurement fits to the edge it sees: what it would find if it saw without error.
FlankAngles outline_angles(const render::Truth& truth, double grain_px);

/// The same by the definition, with nothing of what measures pictures: ordinary least squares over
/// every column of the exact outline, grains' bumps and all, between the places where its mean over
/// a grain has 20 and 80 % of that mean's highest. For flanks that are no straight lines, where
/// robust and ordinary lines differ.
FlankAngles defined_angles(const render::Truth& truth, double grain_px);

}  // namespace repose::bench
