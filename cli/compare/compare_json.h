#pragma once

#include <string>

#include "cli/compare/compare_options.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// One object. Missing numbers are null.
std::string compare_json(const ComparePlan& plan, const vision::HeapComparison& comparison);

}  // namespace repose::cli
