#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "calibrate/runs/table_study.h"

/// Programs that make the runs of a study of a table, each run in a folder of its own. What is
/// common to all of them (processes, time limits, the table of runs, which runs to make) is
/// engine_runs.h and engine_study.h; another engine is another implementation of Engine.
namespace repose::calibrate {

inline constexpr const char* kRunFile = "run.json";
inline constexpr const char* kReadingFile = "reading.json";

/// A run that is to be made.
struct EngineRun {
  std::string name;  ///< of its folder: "run_007"
  std::uint64_t seed = 0;
  std::vector<double> values;  ///< of the study's parameters
};

/// A cell of the run's row in the table.
struct EngineReading {
  std::string column;
  std::string cell;      ///< a number, a word such as "failed", or the name of a file in the folder
  bool is_file = false;  ///< the last
};

/// What a run gave.
struct EngineOutcome {
  std::vector<EngineReading> readings;
  std::string failure;  ///< why it gave none; empty: it did
};

class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  Engine(Engine&&) = delete;
  Engine& operator=(Engine&&) = delete;

  /// What a run gives depends on, beside its parameters and seed, as one line. Runs with others are
  /// those of another model.
  virtual std::string identity() const = 0;
  /// The identity of the engine that a folder was prepared by; empty where nothing says it.
  virtual std::string identity_in(const std::filesystem::path& folder) const = 0;

  /// Writes all that the run needs into its folder, which is empty.
  virtual void prepare(const EngineRun& run, const std::filesystem::path& folder) const = 0;
  /// The program of a folder that was prepared. Its output is the caller's to choose.
  virtual base::ProcessStart start(const std::filesystem::path& folder) const = 0;
  /// Once the program has ended well.
  virtual EngineOutcome read_back(const std::filesystem::path& folder) const = 0;
};

/// A command of the user's, [engine] command: gets run.json, and leaves reading.json. Both are
/// described in docs/engines.md. Proved by OneRunTest.* in tests/calibrate.
std::unique_ptr<Engine> command_engine(const TableStudy& study);

}  // namespace repose::calibrate
