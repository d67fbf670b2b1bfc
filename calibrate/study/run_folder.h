#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/study/study_simulator.h"

namespace repose::calibrate {

/// The runs of a study on disk, a file each: FOLDER/runs/KEY.json, there whole or not at all, so
/// that a kill loses no more than what is being simulated. A heap's final state lies beside it as
/// KEY.vtp. Keys say what was simulated, not for which study: runs are found again in a study with
/// other bounds or measurements.
class RunFolder {
 public:
  /// @throws std::invalid_argument  the folder cannot be made or written.
  explicit RunFolder(std::filesystem::path folder);

  std::filesystem::path runs() const { return folder_ / "runs"; }

  /// None when it was not kept; a file that is damaged or of something else counts as not kept, and
  /// is overwritten when the job has been run again.
  std::optional<Run> find(const StudySimulator& simulator, const Job& job) const;

  /// @throws std::invalid_argument  it cannot be written; what was kept before stays.
  void keep(const StudySimulator& simulator, const SimulatedJob& done) const;

  /// Copies the state of a heap that was kept to FOLDER/NAME, over an older one; false when it is
  /// not there.
  bool copy_state(const StudySimulator& simulator, const Job& job, const std::string& name) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace repose::calibrate
