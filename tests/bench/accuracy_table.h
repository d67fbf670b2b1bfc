#pragma once

#include <span>
#include <string>

#include "tests/bench/accuracy_row.h"

namespace repose::bench {

/// The tables of one section and method. One line per condition of the group, then their total.
std::string group_table(std::span<const Row> rows, testing::Group group);

/// How many of the pictures without an angle were refused.
std::string refusal_table(std::span<const Row> rows);

/// Mean errors with their signs where the picture's outline has another angle than the heap: how
/// much of them is in the picture, and how much the measurement adds.
std::string bias_table(std::span<const Row> rows);

}  // namespace repose::bench
