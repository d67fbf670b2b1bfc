#pragma once

#include <array>

#include "vision/compare/heap_comparison.h"

namespace repose::vision {

/// Adds the pictures' own warnings, and what the comparison could not do and why.
void add_notes(HeapComparison& result, const std::array<const ReposeAngle*, 2>& measured,
               const CompareOptions& options);

}  // namespace repose::vision
