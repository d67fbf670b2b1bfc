#pragma once

#include <string>

#include "calibrate/published/published_method.h"
#include "cli/calibrate/calibrate_options.h"

/// What `repose calibrate --method paper` tells.
namespace repose::cli {

std::string paper_table(const CalibratePlan& plan, const calibrate::PublishedOutcome& outcome,
                        int columns);

/// Everything, as JSON. The same study gives the same bytes.
std::string paper_json(const CalibratePlan& plan, const calibrate::PublishedOutcome& outcome);

}  // namespace repose::cli
