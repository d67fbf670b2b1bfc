#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/report/measure_report.h"
#include "cli/measure/measure_options.h"
#include "vision/hints/proposal.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

enum class Outcome {
  measured,        ///< or refused: `angle` says
  bad_input,       ///< not read, or a box outside it: `error` says
  internal_error,  ///< our own error
};

struct MeasuredPicture {
  std::string file;
  Outcome outcome = Outcome::measured;
  std::string error;
  vision::ReposeAngle angle;    ///< without the outline and edge points, which are large
  vision::MeasureOptions used;  ///< with the picture's own hints, without the mask's pixels
  std::optional<vision::Proposal> proposal;  ///< what would help, when it is refused
  std::string overlay_error;                 ///< why there is no overlay
  calibrate::report::PageJpeg overlay;       ///< where the plan keeps them
};

/// Measures the plan's pictures, several at a time, each from reading to overlay before the next,
/// so that no more than plan.threads pictures are in memory. In the plan's order, and the same at
/// any number of threads.
///
/// Stops between pictures when `is_interrupted`; the result is then worth nothing.
std::vector<MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                           const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
