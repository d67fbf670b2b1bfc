#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "cli/simulate_options.h"
#include "vision/repeats.h"

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
  dem::Repeat repeat;      ///< counts when done; its state is in the file
  std::string state_file;  ///< empty: none was asked for
  double wall_s = 0;       ///< of all calls that worked on it
  std::string fault;       ///< why it is not done
};

/// Runs all repeats that the --out folder does not hold already, several at a time, and writes each
/// one's state when it is done. The first that fails, or an interruption, breaks the others off.
std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted);

/// Mean and scatter of the repeats' values; none when one of them is no number. Values that are all
/// the same to the last bit, as where nothing is left to chance, have a mean but no scatter: an
/// interval of no width would claim what was not found out.
std::optional<vision::Repeats> summarise(const std::vector<Run>& runs);

}  // namespace repose::cli
