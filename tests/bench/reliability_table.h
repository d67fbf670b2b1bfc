#pragma once

#include <span>
#include <string>

#include "tests/bench/accuracy_row.h"

namespace repose::bench {

/// What a stated confidence is worth: how many of the pictures that got an angle got a right one,
/// by confidence. Right is within the stated interval or a degree of the truth; an angle where
/// there is no heap is wrong.
std::string reliability_table(std::span<const Row> rows);

/// How many of the stated intervals hold the truth, by group.
std::string coverage_table(std::span<const Row> rows);

}  // namespace repose::bench
