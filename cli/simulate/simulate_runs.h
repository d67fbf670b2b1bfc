#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "cli/simulate/heap_pictures.h"
#include "cli/simulate/simulate_options.h"

namespace repose::cli {

enum class RunOutcome {
  not_run,
  done,
  no_reading,  ///< it ran, and what it measures did not happen or cannot be trusted
  bad_input,
  internal_error,
};

/// One repeat, done or not.
struct Run {
  RunOutcome outcome = RunOutcome::not_run;
  dem::Repeat repeat;      ///< counts when done; has its state only as long as pictures need it
  std::string state_file;  ///< empty: none was asked for
  double wall_s = 0;       ///< of all calls that worked on it
  std::string error;       ///< why it is not done
  std::optional<HeapPictures> pictures;  ///< none: none were asked for
};

/// Runs all repeats that the --out folder does not hold already, several at a time, and writes each
/// one's state when it is done. The first that fails, or an interruption, breaks the others off.
std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
