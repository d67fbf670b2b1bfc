#pragma once

#include <cstddef>

#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// Member `index` of a sequence that fills the unit box evenly, each stretch of it too.
///
/// Kronecker's additive sequence x_k = frac(1/2 + k / phi^k'), phi the root of x^(d+1) = x + 1:
/// Roberts (2018), "The unreasonable effectiveness of quasirandom sequences". Any number of
/// dimensions; good ones are below 10. Proved by Sequence.* in tests/calibrate.
Point sequence_point(std::size_t index, std::size_t dimensions);

}  // namespace repose::calibrate
