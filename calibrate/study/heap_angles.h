#pragma once

#include <string>
#include <utility>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/study_context.h"

/// What a study's simulated heaps read by each definition of the angle of repose.
namespace repose::calibrate {

/// By a definition's name, in the order of base/angle_definition.h.
using NamedAngles = std::vector<std::pair<std::string, double>>;

/// Mean over the heaps among the runs, as the folder holds them, by the definitions that all of
/// them allow. Empty: there are no heaps.
NamedAngles heap_angles_deg(const StudyContext& context, const std::vector<Run>& runs);

}  // namespace repose::calibrate
