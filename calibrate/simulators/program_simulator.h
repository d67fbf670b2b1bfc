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

/// A simulator that is another program, started once for each run, in a folder of the run's own:
/// its input is prepared there, it runs, and what it leaves is read back. The folder goes away
/// unless the program failed. Proved by ProgramSimulatorTest.* in tests/calibrate.
class ProgramSimulator : public Simulator {
 public:
  bool can_resume() const final { return false; }
  dem::Repeat run(const RunCall& call) const final;

  /// Where what the program prints is, in the run's folder.
  static constexpr const char* kOutputFile = "output.txt";

 protected:
  explicit ProgramSimulator(std::optional<double> timeout_s) : timeout_s_(timeout_s) {}

  /// Writes all that the run needs into its folder, which is empty.
  virtual void prepare(const RunSpec& spec, std::uint64_t seed,
                       const std::filesystem::path& folder) const = 0;
  /// The program of a folder that was prepared. Its output is the caller's to choose.
  virtual base::ProcessStart start(const RunSpec& spec, std::uint64_t seed,
                                   const std::filesystem::path& folder) const = 0;
  /// Once the program has ended well.
  /// @throws dem::NoMeasurement  what is measured did not happen.
  /// @throws base::InputError  it left something else.
  virtual dem::Repeat read_back(const RunSpec& spec, std::uint64_t seed,
                                const std::filesystem::path& folder) const = 0;

 private:
  std::optional<double> timeout_s_;
};

/// The folder of one run of a program, empty at first. It goes away with the object unless it is
/// kept.
class WorkFolder {
 public:
  /// @param asked  where it is to be; empty: a temporary one
  /// @throws base::InputError  it cannot be made, or a program is still running there.
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

/// What is known of a program that runs.
struct ProgramWatch {
  std::string title;  ///< for people
  std::optional<double> timeout_s;
  std::function<bool()> goes_on = {};  ///< false interrupts it
};

/// Starts a program in a folder and waits for its end. It prints to
/// ProgramSimulator::kOutputFile there. The folder is kept where it failed.
/// @throws dem::Interrupted
/// @throws base::InputError  it cannot be started, failed, or took too long: with the end of what
/// it
///   printed.
void run_to_end(base::ProcessStart program, WorkFolder& folder, const ProgramWatch& watch);

/// What an executable of that name, looked for in PATH, prints when it is started so; none where
/// there is none, or it fails, or takes more than a minute.
std::optional<std::string> printed_by(const std::vector<std::string>& words);

}  // namespace repose::calibrate
