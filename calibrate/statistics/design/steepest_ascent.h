#pragma once

#include "calibrate/statistics/design/design.h"
#include "calibrate/statistics/regress/regression.h"

namespace repose::calibrate {

/// Runs up (or down) the slope of a fitted first-order surface, from the middle of its factors on:
/// each step changes the coded factors in proportion to their coefficients, and the steepest one by
/// `stride`. Box and Wilson (1951); Montgomery, sec. 11.2. Proved by SteepestAscent.* in
/// tests/calibrate/design_test.cpp.
///
/// @throws base::InputError  every error: a model with other terms, a stride that is not above
/// 0, a level surface, too few runs.
Design steepest_ascent(const Regression& regression, int runs, double stride, bool descends);

}  // namespace repose::calibrate
