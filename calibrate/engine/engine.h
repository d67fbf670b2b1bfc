#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "calibrate/runs/table_study.h"

/// Programs that make the runs of a table study, each run in its own folder. What they have in
/// common (processes, time limits, the table of runs, which runs to make) is in engine_runs.h and
/// engine_study.h; each engine is an implementation of Engine.
namespace repose::calibrate {

inline constexpr const char* kRunFile = "run.json";
inline constexpr const char* kReadingFile = "reading.json";

/// A run to be made.
struct EngineRun {
  std::string name;  ///< of its folder: "run_007"
  std::uint64_t seed = 0;
  std::vector<double> values;  ///< of the study's parameters
};

/// A cell of the run's row in the table.
struct EngineReading {
  std::string column;
  std::string cell;      ///< a number, a word such as "failed", or the name of a file in the folder
  bool is_file = false;  ///< the cell is a file name
};

/// The outcome of a run.
struct EngineOutcome {
  std::vector<EngineReading> readings;
  std::string failure;  ///< why there are no readings; empty: there are
};

class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  Engine(Engine&&) = delete;
  Engine& operator=(Engine&&) = delete;

  /// Everything besides parameters and seed that a run's outcome depends on, as one line. Runs with
  /// a different identity are of another model.
  virtual std::string identity() const = 0;
  /// The identity of the engine that prepared a folder; empty if not recorded.
  virtual std::string identity_in(const std::filesystem::path& folder) const = 0;

  /// Writes everything the run needs into its folder, which must be empty.
  virtual void prepare(const EngineRun& run, const std::filesystem::path& folder) const = 0;
  /// The program to start in a prepared folder. The caller chooses where its output goes.
  virtual base::ProcessStart start(const std::filesystem::path& folder) const = 0;
  /// To be called once the program has succeeded.
  virtual EngineOutcome read_back(const std::filesystem::path& folder) const = 0;
};

/// A user's command ([engine] command) that reads run.json and writes reading.json. Both are
/// described in docs/engines.md. Proved by OneRunTest.* in tests/calibrate.
std::unique_ptr<Engine> command_engine(const TableStudy& study);

}  // namespace repose::calibrate
