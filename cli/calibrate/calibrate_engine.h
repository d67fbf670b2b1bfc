#pragma once

#include <string>
#include <vector>

#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Whether the study says how its runs are made: [engine]. False where it cannot be read.
bool has_engine(const CalibrateArguments& arguments);

/// Carries out `repose calibrate` of a study with [engine], whose command makes the runs.
ExitCode run_calibrate_engine(const CalibrateArguments& arguments);

/// Options of simulations, of which none is made: an error for each.
/// @param what  makes the runs, as in "with --runs none is made"
void refuse_simulations(const CalibrateArguments& arguments, const char* what,
                        std::vector<std::string>& errors);

}  // namespace repose::cli
