#pragma once

#include "dem/shape/clump/clump_shape.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// About how long one run takes on one core, s. It decides how many runs of each experiment a
/// budget pays, so it is made from the study alone: the same on every machine.
double run_cost_s(const dem::Study& study, const dem::ClumpShape& grain,
                  dem::Experiment experiment);

}  // namespace repose::calibrate
