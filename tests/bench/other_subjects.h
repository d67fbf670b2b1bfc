#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/subject.h"

namespace repose::bench {

/// Every kind of picture without a heap with each of `seeds` seeds.
std::vector<Subject> other_subjects(int seeds, std::uint64_t first_seed);

}  // namespace repose::bench
