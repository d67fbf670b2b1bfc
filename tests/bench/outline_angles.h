#pragma once

#include "render/truth.h"
#include "tests/bench/subject.h"

namespace repose::bench {

/// Flanks of an exact outline over 20 to 80 % of its height above the exact ground, by the line fit
/// of the measurement: the result that a measurement without detection errors would give.
FlankAngles outline_angles(const render::Truth& truth, double grain_px);

/// The same by the definition, independent of the measuring code: ordinary least squares over every
/// column of the exact outline, grains' bumps included, between the places where its running mean
/// over one grain reaches 20 and 80 % of that mean's maximum. For flanks that are not straight,
/// where robust and ordinary fits differ.
FlankAngles defined_angles(const render::Truth& truth, double grain_px);

}  // namespace repose::bench
