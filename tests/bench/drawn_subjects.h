#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/subject.h"

namespace repose::bench {

/// Every condition of drawn pictures with each of `seeds` seeds.
std::vector<Subject> drawn_subjects(int seeds, std::uint64_t first_seed);

}  // namespace repose::bench
