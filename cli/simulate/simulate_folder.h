#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/simulate/simulate_options.h"

/// What a `repose simulate --out FOLDER` leaves there beside the store of runs
/// (calibrate/experiment/run_folder.h): run.json, which says whose the files named after seeds are,
/// those files, and the result.
namespace repose::cli {

/// "FOLDER/heap_seed_3": what a repeat's files are called, without their endings.
std::filesystem::path place_of(const SimulatePlan& plan, std::uint64_t seed);

/// FOLDER/result.json. In the folder of a study, which has a result of its own,
/// FOLDER/EXPERIMENT.json.
std::filesystem::path result_file(const SimulatePlan& plan);

/// What is wrong with going on with what the folder holds: files of another run, which would be
/// mixed with those of this one. Empty: nothing is.
std::string error_of_saved(const SimulatePlan& plan);

/// What there is to go on from, and what of it is damaged: a sentence each.
std::vector<std::string> notes_on_saved(const SimulatePlan& plan);

/// Says in the folder what its files belong to.
void save_identity(const SimulatePlan& plan);

}  // namespace repose::cli
