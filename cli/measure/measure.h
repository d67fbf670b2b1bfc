#pragma once

#include <atomic>
#include <vector>

#include "calibrate/measured/measured_file.h"
#include "cli/common/output.h"
#include "cli/measure/measure_options.h"

namespace repose::cli {

/// Measures the plan's pictures and films, several at a time, each from reading to overlay before
/// the next, so that no more than plan.threads pictures are in memory. In the plan's order, a
/// film's frames behind its heap at rest, and the same at any number of threads.
///
/// Stops between pictures, and in the middle of a film, when `is_interrupted`; the result is then
/// worth nothing.
std::vector<calibrate::MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                                      const std::atomic<bool>& is_interrupted);

/// Carries out `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
