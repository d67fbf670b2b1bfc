#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/result/result.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Carries out `repose calibrate --runs`: the fit to a table of runs of another program.
ExitCode run_calibrate_runs(const CalibrateArguments& arguments);

// What it has in common with studies whose runs an engine makes.

/// Options of simulations, of which none is made: an error for each.
/// @param what  makes the runs, as in "with --runs none is made"
void refuse_simulations(const CalibrateArguments& arguments, const char* what,
                        std::vector<std::string>& errors);

/// That --json would write over what is read, or over the study's folder: an error.
void check_json_place(const CalibrateArguments& arguments, const std::filesystem::path& folder,
                      std::vector<std::string>& errors);

/// Writes --json, and shows the table.
void show_fit(const CalibrateArguments& arguments, const calibrate::StudyResult& result);

}  // namespace repose::cli
