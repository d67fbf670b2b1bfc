#pragma once

#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/further_runs.h"

namespace repose::calibrate {

/// README.txt of an export: how to run it, how each coefficient was converted, what does not carry
/// over.
/// @param sets  equally good sets; a single one is not mentioned
ExportedFile readme_of(const ExportFacts& facts, const ExportRequest& request,
                       const std::vector<Conversion>& conversions,
                       const std::vector<std::vector<double>>& sets, const FurtherRuns& further);

}  // namespace repose::calibrate
