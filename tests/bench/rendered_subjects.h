#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/subject.h"

namespace repose::bench {

/// Every condition of rendered pictures with each of `seeds` seeds. The true angle is the heap's
/// own: that of its exact outline seen by a level camera from far away.
///
/// Pictures are taken one at a time, whatever the number of threads.
std::vector<Subject> rendered_subjects(int seeds, std::uint64_t first_seed);

}  // namespace repose::bench
