#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "vision/scan/scanned_heap.h"
#include "vision/scan/slices.h"

/// What a scanned heap's numbers are worth: by the limits of pictures where they have the same.

namespace repose::vision {

inline constexpr double kMostRimCut = 0.01;  ///< of the base's rim: beyond, it has no volume

std::string few_points_reason(std::size_t points);

/// Why there is no number, and what to do.
std::optional<std::string> reason_against(const Slices& slices, const ScannedHeap& heap);

/// Adds what a person should know or must look at. `heap` has its angle and interval.
/// @param others  smaller bodies on the ground beside it
/// @param ledge   its height around the foot, of the heap's; none: there is none
void warn_of_scan(const Slices& slices, int others, std::optional<double> ledge, ScannedHeap& heap);

}  // namespace repose::vision
