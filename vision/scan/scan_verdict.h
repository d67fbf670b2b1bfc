#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "vision/scan/scanned_heap.h"
#include "vision/scan/slices.h"

/// Judges a scanned heap's numbers, by the same limits as for pictures where they apply.

namespace repose::vision {

inline constexpr double kMostRimCut = 0.01;  ///< fraction of the base's rim: above it, there is no
                                             ///< volume

std::string few_points_reason(std::size_t points);

/// Why there is no number, and what to do.
std::optional<std::string> reason_against(const Slices& slices, const ScannedHeap& heap);

/// Adds warnings and flags. `heap` has its angle and interval.
/// @param others  smaller bodies on the ground beside it
/// @param ledge   its height around the foot, as a fraction of the heap's; std::nullopt: no ledge
void warn_of_scan(const Slices& slices, int others, std::optional<double> ledge, ScannedHeap& heap);

}  // namespace repose::vision
