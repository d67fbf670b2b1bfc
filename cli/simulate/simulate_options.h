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
  dem::Experiment experiment = nullptr;  ///< null: unknown, as `errors` say
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
  /// Of drops read in air: what their mean would be without, as the simulation is.
  std::optional<double> mean_without_air;

  /// On the folder, from before it was looked at until the results are in it.
  std::optional<base::FolderLock> lock;

  std::vector<std::string> errors;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user to know
};

/// Reads and checks all that was typed, the study and the place for the results, then builds the
/// grain, which may take seconds. All errors at once.
SimulatePlan plan_simulate(const SimulateArguments& arguments);

}  // namespace repose::cli
