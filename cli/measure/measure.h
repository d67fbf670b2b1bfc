#pragma once

#include <atomic>
#include <vector>

#include "calibrate/measured/measured_file.h"
#include "cli/common/output.h"
#include "cli/measure/measure_options.h"

namespace repose::cli {

/// Measures the plan's pictures and films, several at a time, each from reading to overlay before
/// the next, so that at most plan.threads pictures are in memory. Results are in the plan's order,
/// a film's frames after its heap at rest, and do not depend on the number of threads.
///
/// Stops between pictures, or in the middle of a film, when `is_interrupted`; the result is then
/// unusable.
std::vector<calibrate::MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                                      const std::atomic<bool>& is_interrupted);

/// Runs `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
