#pragma once

#include <vector>

#include "calibrate/experiment/run_folder.h"
#include "calibrate/fit/problem.h"
#include "calibrate/plan/offered_study.h"
#include "dem/shape/clump/clump_file.h"

/// What plans have left for a calibration's advice.
namespace repose::calibrate {

/// The runs that plan_jobs() of any budget have left in the folder, of experiments that the study
/// does not have: nothing is simulated.
/// @param study  as simulated (as_simulated), sound for a fit
std::vector<Offer> offers_in(const RunFolder& folder, const dem::Study& study,
                             const dem::ClumpFile& grain);

}  // namespace repose::calibrate
