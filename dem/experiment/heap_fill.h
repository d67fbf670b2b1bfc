#pragma once

#include "dem/experiment/course.h"
#include "dem/experiment/experiment.h"

namespace repose::dem {

/// The walls of the heap experiment, in this order.
inline constexpr int kHeapPlate = 0;
inline constexpr int kHeapTube = 1;

/// A simulation of the tube on its plate, full of grains at rest, its time set back to 0.
///
/// The grains rain in layers, each a little above what is there: places and poses are random. What
/// lies above the rim in the end is taken off. Throws std::invalid_argument when
/// `protocol.grains` are more than fit.
Course fill_tube(const Bench& bench, const HeapProtocol& protocol, std::uint64_t seed,
                 const ProgressReport& report);

}  // namespace repose::dem
