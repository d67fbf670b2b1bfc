#pragma once

#include "vision/measure/choice.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Decides whether the measured number may be used: fills in the status, reason, confidence and
/// warnings of an otherwise complete result.
void judge(ReposeAngle& result, const SelectedCandidate& choice, const MeasureOptions& options);

}  // namespace repose::vision
