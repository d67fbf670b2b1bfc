#pragma once

#include <span>
#include <string>

#include "tests/bench/accuracy_row.h"

namespace repose::bench {

/// How reliable a stated confidence is: the fraction of pictures with an angle whose angle is
/// right, by confidence. Right means within the stated interval or a degree of the truth; an angle
/// where there is no heap is wrong.
std::string reliability_table(std::span<const Row> rows);

/// How many of the stated intervals contain the truth, by group.
std::string coverage_table(std::span<const Row> rows);

}  // namespace repose::bench
