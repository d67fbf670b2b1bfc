#pragma once

#include <optional>
#include <string>

#include "cli/compare/compare_options.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// The comparison as a readable table, at most `columns` wide.
std::string compare_table(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns);

/// The comparison of two sets as a readable table, for a terminal of this width.
/// @param grain_m  size of a grain, for lengths in grains
std::string sets_table(const calibrate::ComparedSets& compared,
                       const std::optional<double>& grain_m, int columns);

}  // namespace repose::cli
