#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"

namespace repose::dem {

/// The times of a film's frames so far.
struct Film {
  std::vector<double> times_s;
  double start_s = 0;  ///< of the simulation at hand, in the film
  double last_s = 0;   ///< of the simulation when last added
};

/// A film of a run: frame_00001.vtp, ... (state files) and trajectory.pvd, which ParaView opens as
/// a series in time. All is whole at any moment.
class TrajectoryWriter {
 public:
  /// The folder is made when it is missing. `film`: of a writer that this one goes on from.
  /// @throws base::InputError  interval_s is not above 0, or the folder cannot be made.
  TrajectoryWriter(std::filesystem::path folder, double interval_s, std::string provenance_json,
                   Film film = {});

  /// Writes a frame. A simulation that starts from time 0 again is shown `interval_s` after the one
  /// before.
  /// @throws base::InputError  it cannot be written.
  void add(const Simulation& simulation);

  const Film& film() const { return film_; }

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  double interval_s_;
  std::string provenance_json_;
  Film film_;
};

/// One state of a film.
struct TrajectoryFrame {
  double time_s = 0;           ///< in the film
  std::filesystem::path file;  ///< state file
};

/// The frames that a trajectory.pvd names, in its order; none of them is looked at.
/// @throws base::InputError  no such file, no collection, or one without frames.
std::vector<TrajectoryFrame> read_trajectory(const std::filesystem::path& file);

}  // namespace repose::dem
