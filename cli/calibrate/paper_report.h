#pragma once

#include <string>

#include "calibrate/paper/paper_way.h"
#include "cli/calibrate/calibrate_options.h"

/// What `repose calibrate --method paper` tells.
namespace repose::cli {

std::string paper_table(const CalibratePlan& plan, const calibrate::PaperOutcome& outcome,
                        int columns);

/// Everything, as JSON. The same study gives the same bytes.
std::string paper_json(const CalibratePlan& plan, const calibrate::PaperOutcome& outcome);

}  // namespace repose::cli
