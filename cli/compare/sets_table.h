#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/compare/compare_options.h"
#include "vision/compare/heap_sets.h"

namespace repose::cli {

/// The comparison of two sets as people read it, for a terminal of some width.
std::string sets_table(const ComparePlan& plan,
                       const std::array<std::vector<vision::SeenHeap>, 2>& heaps,
                       const vision::SetComparison& comparison, int columns);

/// What a set is called in tables and figures.
std::string title_of(const HeapSource& source);

}  // namespace repose::cli
