#pragma once

#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// Of each parameter, foreseen by linear Bayes over the plausible sets: Goldstein and Wooff (2007),
/// Bayes Linear Statistics. `spent_s`: work of one core in the runs so far, above 0. Formulae and
/// reasons: THEORY.md, "What would narrow it". Proved by Narrowing.* in tests/calibrate.
std::vector<Narrowing> narrowing_of(const Solution& solution, double spent_s);

}  // namespace repose::calibrate
