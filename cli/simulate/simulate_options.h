#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/folder_lock.h"
#include "calibrate/experiment/run_spec.h"
#include "dem/study/study.h"

namespace repose::cli {

/// What `repose simulate` is asked to do, as typed; empty: not given.
struct SimulateArguments {
  std::string experiment;  ///< its name: "heap"
  std::string study;
  std::vector<std::string> settings;  ///< key.path=value
  std::string seed;
  std::string repeats;
  std::string threads;
  std::string out_folder;
  std::string json_file;
  std::string trajectory_s;
  std::string views;
  std::string engine;
  std::string processes;
};

/// A `repose simulate` that can be carried out.
struct SimulatePlan {
  dem::Experiment experiment = nullptr;  ///< null: unknown, see `errors`
  dem::Study study;
  std::vector<std::string> settings;
  dem::ClumpFile grain;
  calibrate::RunSpec spec;  ///< of each repeat
  std::vector<std::uint64_t> seeds;
  int threads = 1;
  std::filesystem::path out_folder;  ///< empty: none
  std::string json_file;
  std::optional<double> trajectory_s;
  int views = 0;  ///< pictures of each heap
  /// For drops measured in air: their mean corrected to no air, as in the simulation.
  std::optional<double> mean_without_air;

  /// On the folder, held from before it is examined until the results are written.
  std::optional<base::FolderLock> lock;

  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user
};

/// Reads and checks all arguments, the study and the output paths, then builds the grain, which may
/// take seconds. Reports all errors at once.
SimulatePlan plan_simulate(const SimulateArguments& arguments);

}  // namespace repose::cli
