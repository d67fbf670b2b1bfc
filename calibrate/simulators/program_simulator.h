#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

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
  base::ProcessEnd wait_for(base::ChildProcess& program, const RunCall& call,
                            const std::filesystem::path& folder) const;

  std::optional<double> timeout_s_;
};

/// What an executable of that name, looked for in PATH, prints when it is started so; none where
/// there is none, or it fails, or takes more than a minute.
std::optional<std::string> printed_by(const std::vector<std::string>& words);

}  // namespace repose::calibrate
