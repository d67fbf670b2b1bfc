#pragma once

#include <string>
#include <vector>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// What `repose simulate` is asked to do, as typed; empty: not given.
struct SimulateArguments {
  std::string experiment;  ///< one of dem::experiment_names()
  std::string study;
  std::vector<std::string> settings;  ///< key.path=value
  std::string seed;
  std::string repeats;
  std::string threads;
  std::string out_folder;
  std::string json_file;
  std::string trajectory_s;
  std::string views;
};

/// Carries out `repose simulate`.
///
/// Exit codes: 2 for a study or options that cannot be run; 3 (nothing measurable) when a run went
/// unstable or gave no reading: there is no result, and the mean of the other repeats would not be
/// one; 130 when interrupted. States of repeats that were finished are whole then, result.json and
/// --json are not written. With an --out folder the same call then goes on where it was
/// interrupted, to the same bytes (simulate_folder.h).
ExitCode run_simulate(const SimulateArguments& arguments);

}  // namespace repose::cli
