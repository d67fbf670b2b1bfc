#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/experiment/run_result.h"
#include "cli/simulate/simulate_options.h"

/// The repeats of a `repose simulate`, and what they leave in its --out FOLDER beside the store of
/// runs (calibrate/experiment/run_store.h): run.json, which says whose the files named after seeds
/// are, those files, and the result.
namespace repose::cli {

/// What of a run was put into the folder; empty: nothing.
struct RunFiles {
  std::string state;
  std::string overlay;  ///< of a heap's first view or a draw-down
};

/// A repeat that could not be made.
struct RepeatError {
  std::uint64_t seed = 0;
  std::string message;
  bool is_internal = false;  ///< else its input is wrong
};

/// In the order of their seeds.
struct Repeats {
  std::vector<calibrate::RunResult> runs;  ///< those that came to an end, also without a reading
  std::vector<RunFiles> files;             ///< of each of these
  std::vector<RepeatError> errors;         ///< of others
};

/// Runs all repeats that the --out folder does not hold already, several at a time, and puts each
/// one's state and overlay there under the name of its seed. The first with an error, or an
/// interruption, stops the others; one without a reading does not.
Repeats run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted);

/// FOLDER/result.json. In the folder of a study, which has a result of its own,
/// FOLDER/EXPERIMENT.json.
std::filesystem::path result_file(const SimulatePlan& plan);

/// What is wrong with going on with what the folder holds: files of another run, which would be
/// mixed with those of this one. Empty: nothing is.
std::string error_of_saved(const SimulatePlan& plan);

/// What there is to go on from, and what of it is damaged: a sentence each.
std::vector<std::string> notes_on_saved(const SimulatePlan& plan);

}  // namespace repose::cli
