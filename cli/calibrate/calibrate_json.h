#pragma once

#include <string>

#include "calibrate/study/study_run.h"
#include "cli/calibrate/calibrate_options.h"

namespace repose::cli {

/// "determined", "one-sided" or "undetermined".
std::string name_of(calibrate::Verdict verdict);

/// Everything, as JSON: coefficients, observables, sets that fit as well, what it all belongs to.
/// The same study gives the same bytes.
std::string calibrate_json(const CalibratePlan& plan, const calibrate::StudyOutcome& outcome);

/// All that coefficients belong to, as JSON.
std::string provenance_text(const CalibratePlan& plan);

/// What a result.json is called when another one takes its place: "result_quick_1b9d6bcd.json".
/// Empty when it is of the same study, method and budget, or no such
/// file.
std::string name_when_set_aside(const std::string& old_json, const CalibratePlan& plan);

}  // namespace repose::cli
