#pragma once

#include <cstdint>

#include "tests/support/heap_scene.h"

/// Heaps whose flanks are not straight, and heaps of few grains.
namespace repose::testing {

HeapScene hollow_power(std::uint64_t seed);
HeapScene hollow_exponential(std::uint64_t seed);

/// Its crest is at the wall, as in a tank that is emptied through its floor.
HeapScene hollow_half_heap(std::uint64_t seed);

/// A layer of one to two grains extends far beyond the toe. It is not part of the flank.
HeapScene hollow_apron(std::uint64_t seed);

HeapScene few_grains(std::uint64_t seed);
HeapScene few_grains_hollow(std::uint64_t seed);

}  // namespace repose::testing
