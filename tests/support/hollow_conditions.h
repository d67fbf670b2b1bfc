#pragma once

#include <cstdint>

#include "tests/support/heap_scene.h"

/// Heaps whose flanks are no straight lines, and heaps of few grains.
namespace repose::testing {

HeapScene hollow_power(std::uint64_t seed);
HeapScene hollow_exponential(std::uint64_t seed);

/// Its crest is where it meets the wall, as in a tank that is emptied through its floor.
HeapScene hollow_half_heap(std::uint64_t seed);

/// One to two grains lie on the ground far beyond the toe. They are not of the flank.
HeapScene hollow_apron(std::uint64_t seed);

HeapScene few_grains(std::uint64_t seed);
HeapScene few_grains_hollow(std::uint64_t seed);

}  // namespace repose::testing
