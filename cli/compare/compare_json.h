#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/compare/compare_options.h"
#include "vision/compare/heap_sets.h"

namespace repose::cli {

/// One object. A number that does not exist is null.
std::string compare_json(const ComparePlan& plan, const vision::HeapComparison& comparison);

/// What `repose compare --json` writes of two sets; see docs/json.md.
std::string sets_json(const ComparePlan& plan,
                      const std::array<std::vector<vision::SeenHeap>, 2>& heaps,
                      const vision::SetComparison& comparison);

}  // namespace repose::cli
