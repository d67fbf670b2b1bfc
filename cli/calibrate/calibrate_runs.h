#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/result/result.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/common/output.h"

namespace repose::cli {

/// Runs `repose calibrate --runs`: the fit to a table of runs of another program.
ExitCode run_calibrate_runs(const CalibrateArguments& arguments);

// Shared with studies whose runs an engine makes.

/// Adds an error for each simulation option, as nothing is simulated.
/// @param what  source of the runs, as in "with --runs none is made"
void refuse_simulations(const CalibrateArguments& arguments, const char* what,
                        std::vector<std::string>& errors);

/// Adds an error if --json would overwrite an input or the study's folder.
void check_json_place(const CalibrateArguments& arguments, const std::filesystem::path& folder,
                      std::vector<std::string>& errors);

/// Writes --json and shows the table.
void show_fit(const CalibrateArguments& arguments, const calibrate::StudyResult& result);

}  // namespace repose::cli
