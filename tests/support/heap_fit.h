#pragma once

#include <vector>

#include "tests/support/heap_picture.h"
#include "tests/support/heap_random.h"

namespace repose::testing {

/// How far chance takes the exact outline from the constructed flanks: least squares over 20 to
/// 80 % of the height, less the true angle, of every flank that exists.
std::vector<double> outline_errors_rad(const DrawnHeap& heap);

/// A flank of few grains strays from its line by chance: takes a heap that keeps to it.
void settle(HeapScene& scene, Random& random);

}  // namespace repose::testing
