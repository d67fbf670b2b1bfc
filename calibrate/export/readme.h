#pragma once

#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

namespace repose::calibrate {

/// README.txt of an export: how to run it, what became of each coefficient, what does not carry
/// over.
ExportedFile readme_of(const ExportFacts& facts, ExportTarget target,
                       const std::vector<Conversion>& conversions);

}  // namespace repose::calibrate
