#pragma once

#include <string>

#include "cli/compare/compare_options.h"

namespace repose::cli {

/// The comparison for people to read, at most `columns` wide.
std::string compare_table(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns);

}  // namespace repose::cli
