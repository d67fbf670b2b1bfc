#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// Of each parameter, foreseen by linear Bayes over the plausible sets: Goldstein and Wooff (2007),
/// Bayes Linear Statistics. `spent_s`: work of one core in the runs so far, above 0. Formulae and
/// reasons: THEORY.md, "What would narrow it". Proved by Narrowing.* in tests/calibrate.
std::vector<Narrowing> narrowing_of(const Solution& solution, double spent_s);

/// What takes away this share of a parameter's variance is worth its while.
inline constexpr double kWorthwhile = .3;
/// `left`: of its standard deviation.
inline bool is_worthwhile(double left) { return 1 - left * left > kWorthwhile; }

/// Times as many readings as there are: half the uncertainty of their mean.
inline constexpr int kMoreReadings = 4;

/// Of each parameter, likewise: how wide its interval would be, as a part of its present width,
/// with kMoreReadings times the readings of one observable.
std::vector<double> narrowing_by_readings(const Solution& solution, std::size_t observable);

}  // namespace repose::calibrate
