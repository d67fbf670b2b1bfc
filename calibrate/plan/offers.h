#pragma once

#include <vector>

#include "calibrate/experiment/run_folder.h"
#include "calibrate/fit/problem.h"
#include "calibrate/plan/offered_study.h"
#include "dem/shape/clump/clump_file.h"

/// What a calibration's advice can be made from.
namespace repose::calibrate {

/// Every experiment that the study does not have, done in the usual way, with the runs that
/// plan_jobs() of any budget have left in the folder: nothing is simulated.
/// @param study  as measured (as_measured), sound for a fit
std::vector<Offer> offers_in(const RunFolder& folder, const dem::Study& study,
                             const dem::ClumpFile& grain);

}  // namespace repose::calibrate
