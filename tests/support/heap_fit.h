#pragma once

#include <vector>

#include "tests/support/heap_picture.h"
#include "tests/support/heap_random.h"

namespace repose::testing {

/// Random deviation of the exact outline from the constructed flanks: the least-squares angle over
/// 20 to 80 % of the height, less the true angle, for every flank that exists.
std::vector<double> outline_errors_rad(const DrawnHeap& heap);

/// A flank of few grains deviates from its line by chance: chooses a heap that follows it.
void settle(HeapScene& scene, Random& random);

}  // namespace repose::testing
