#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/experiment/run_result.h"
#include "cli/simulate/simulate_options.h"

/// The repeats of a `repose simulate`, and what they write to its --out FOLDER besides the run
/// store (calibrate/experiment/run_store.h): run.json, which identifies the run that files named
/// after seeds belong to; those files; and the result.
namespace repose::cli {

/// Files of a run in the folder; empty: none.
struct RunFiles {
  std::string state;
  std::string overlay;  ///< of a heap's first view or of a draw-down
};

/// A repeat that could not be made.
struct RepeatError {
  std::uint64_t seed = 0;
  std::string message;
  bool is_internal = false;  ///< otherwise the input is wrong
};

/// Results of all repeats, in the order of their seeds.
struct Repeats {
  std::vector<calibrate::RunResult> runs;  ///< those that finished, also without a reading
  std::vector<RunFiles> files;             ///< of each of these runs
  std::vector<RepeatError> errors;         ///< of the others
};

/// Runs all repeats not yet in the --out folder, several at a time, and writes each one's state and
/// overlay there, named after its seed. The first error, or an interruption, stops the others; a
/// missing reading does not.
Repeats run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted);

/// FOLDER/result.json. In a study's folder, which has its own result: FOLDER/EXPERIMENT.json.
std::filesystem::path result_file(const SimulatePlan& plan);

/// Why the folder cannot be continued: it holds files of another run, which would be mixed with
/// this one's. Empty: it can.
std::string error_of_saved(const SimulatePlan& plan);

/// What can be resumed, and which of it is damaged: a sentence each.
std::vector<std::string> notes_on_saved(const SimulatePlan& plan);

}  // namespace repose::cli
