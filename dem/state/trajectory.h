#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"

namespace repose::dem {

/// A film of a run: frame_00001.vtp, ... (state files) and trajectory.pvd, which ParaView opens as
/// a series in time. All is whole at any moment.
class TrajectoryWriter {
 public:
  /// The folder is made when it is missing.
  /// @throws std::invalid_argument  interval_s is not above 0, or the folder cannot be made.
  TrajectoryWriter(std::filesystem::path folder, double interval_s, std::string provenance_json);

  /// Writes a frame when `interval_s` has passed since the last one, and the first time. A
  /// simulation that starts from time 0 again is shown after the one before.
  /// @throws std::invalid_argument  it cannot be written.
  void offer(const Simulation& simulation);

  int frames() const { return static_cast<int>(times_s_.size()); }

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  double interval_s_;
  std::string provenance_json_;
  std::vector<double> times_s_;  ///< of the frames, in the film
  double start_s_ = 0;           ///< of the simulation at hand, in the film
  double last_s_ = 0;            ///< of the simulation when last offered
};

}  // namespace repose::dem
