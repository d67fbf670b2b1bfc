#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/simulator.h"

namespace repose::calibrate {

/// A simulator that starts another program for each run, in the run's own folder: its input is
/// prepared there, it runs, and its output is read back. The folder is deleted unless the program
/// failed. Proved by ProgramSimulatorTest.* in tests/calibrate.
class ProgramSimulator : public Simulator {
 public:
  bool can_resume() const final { return false; }
  dem::Repeat run(const RunCall& call) const final;

  /// File for the program's printed output, in the run's folder.
  static constexpr const char* kOutputFile = "output.txt";

 protected:
  explicit ProgramSimulator(std::optional<double> timeout_s) : timeout_s_(timeout_s) {}

  /// Writes everything the run needs into its folder, which is empty.
  virtual void prepare(const RunSpec& spec, std::uint64_t seed,
                       const std::filesystem::path& folder) const = 0;
  /// The program to start in a prepared folder. The caller chooses where its output goes.
  virtual base::ProcessStart start(const RunSpec& spec, std::uint64_t seed,
                                   const std::filesystem::path& folder) const = 0;
  /// To be called once the program has succeeded.
  /// @throws dem::NoMeasurement  the measured event did not happen.
  /// @throws base::InputError  its output is not as expected.
  virtual dem::Repeat read_back(const RunSpec& spec, std::uint64_t seed,
                                const std::filesystem::path& folder) const = 0;

 private:
  std::optional<double> timeout_s_;
};

/// The folder of one run of a program, initially empty. The destructor deletes it unless keep() was
/// called.
class WorkFolder {
 public:
  /// @param asked  its path; empty: a temporary folder
  /// @throws base::InputError  it cannot be created, or a program is still running there.
  explicit WorkFolder(const std::filesystem::path& asked = {});
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  WorkFolder(WorkFolder&&) = delete;
  WorkFolder& operator=(WorkFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void keep() { is_kept_ = true; }

 private:
  std::filesystem::path path_;
  bool is_kept_ = false;
};

/// How a running program is named, limited and interrupted.
struct ProgramWatch {
  std::string title;  ///< for messages
  std::optional<double> timeout_s;
  std::function<bool()> goes_on = {};  ///< false interrupts it
};

/// Starts a program in a folder and waits for its end. Its output goes to
/// ProgramSimulator::kOutputFile there. The folder is kept if the program failed.
/// @throws dem::Interrupted
/// @throws base::InputError  it cannot be started, failed, or took too long; with the end of its
///   output.
void run_to_end(base::ProcessStart program, WorkFolder& folder, const ProgramWatch& watch);

/// Output of a command whose executable is looked up in PATH; std::nullopt if it does not exist,
/// fails, or takes more than a minute.
std::optional<std::string> printed_by(const std::vector<std::string>& words);

}  // namespace repose::calibrate
