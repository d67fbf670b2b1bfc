#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/design/factor.h"
#include "dem/experiment/faults.h"

namespace repose::calibrate {

/// Adds a fault for too few or too many factors, ranges that are empty or not finite, and names
/// that are missing or the same.
void check_factors(const std::vector<Factor>& factors, std::size_t least, std::size_t most,
                   dem::Faults& faults);

/// Adds a fault for a number that is not from `least` to `most`.
void check_count(const char* what, int count, int least, int most, dem::Faults& faults);

}  // namespace repose::calibrate
