#pragma once

#include <cstddef>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/factor.h"

namespace repose::calibrate {

/// Adds an error for too few or too many factors, ranges that are empty or not finite, and names
/// that are missing or the same.
void check_factors(const std::vector<Factor>& factors, std::size_t least, std::size_t most,
                   base::Faults& errors);

/// Adds an error for a number that is not from `least` to `most`.
void check_count(const char* what, int count, int least, int most, base::Faults& errors);

}  // namespace repose::calibrate
