#pragma once

#include <span>
#include <string>

#include "tests/bench/accuracy_row.h"

namespace repose::bench {

/// The table of one section and method. One line per condition of the group, then their total.
std::string group_table(std::span<const Row> rows, testing::Group group);

/// How many of the pictures without an angle of repose were refused.
std::string refusal_table(std::span<const Row> rows);

/// Signed mean errors for pictures whose outline has a different angle from the heap's: how much
/// comes from the picture and how much from the measurement.
std::string bias_table(std::span<const Row> rows);

}  // namespace repose::bench
