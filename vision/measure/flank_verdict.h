#pragma once

#include <string>

#include "vision/measure/reading.h"

/// What one side of a heap is worth.
namespace repose::vision {

/// Why a side is no flank, and what to do; empty when it is one, or absent.
std::string reason_against(const FlankFit& flank, Side side);

/// Adds what a user should know of a side, and flags what a person must look at. `result` has its
/// intervals.
void warn_of_flank(ReposeAngle& result, const Reading& reading, Side side);

}  // namespace repose::vision
