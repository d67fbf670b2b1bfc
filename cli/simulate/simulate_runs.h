#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "calibrate/experiment/run_result.h"
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
  calibrate::RunResult result;  ///< counts when done
  std::string state_file;       ///< empty: none was asked for
  std::string overlay_file;     ///< of a heap's first view or a draw-down; else empty
  std::string error;            ///< why it is not done
};

/// Runs all repeats that the --out folder does not hold already, several at a time, and puts each
/// one's state and overlay there under the name of its seed. The first with an error, or an
/// interruption, stops the others; one without a reading does not.
std::vector<Run> run_repeats(const SimulatePlan& plan, const std::atomic<bool>& is_interrupted);

}  // namespace repose::cli
