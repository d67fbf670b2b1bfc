#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/bench/accuracy_row.h"

namespace repose::bench {

/// One line per condition of the group, then their total.
std::string group_table(std::span<const Row> rows, testing::Group group, std::string_view method);

/// How many of the pictures without an angle were refused.
std::string refusal_table(std::span<const Row> rows, std::string_view method);

}  // namespace repose::bench
