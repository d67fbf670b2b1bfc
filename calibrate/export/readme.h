#pragma once

#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/further_runs.h"

namespace repose::calibrate {

/// README.txt of an export: how to run it, what became of each coefficient, what does not carry
/// over.
/// @param sets  those that fit as well as each other; of a single one nothing is said
ExportedFile readme_of(const ExportFacts& facts, const ExportRequest& request,
                       const std::vector<Conversion>& conversions,
                       const std::vector<std::vector<double>>& sets, const FurtherRuns& further);

}  // namespace repose::calibrate
