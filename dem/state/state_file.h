#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"

/// The state of a simulation in a file that ParaView can open and from which a run can resume.
///
/// VTK XML PolyData (.vtp), one point per grain that is present: orientation (w x y z), velocity,
/// spin, force, torque, angular_momentum, rolling_limit, mass (SI units, world axes), grain (its
/// number) and kind. Everything else that a run needs (walls, kinds, materials, contacts, grains
/// that have left) is in field-data arrays. Doubles are exact.

namespace repose::dem {

struct SavedState {
  SimulationSetup setup;  ///< for 1 thread: a state does not depend on their number
  Checkpoint checkpoint;
  std::string provenance_json;
};

/// The file's text. Equal states give equal bytes.
/// @param provenance_json  origin of the state, stored verbatim; must not contain zero bytes.
std::string state_text(const Simulation& simulation, const std::string& provenance_json);

/// Writes it atomically.
/// @throws base::InputError  the file cannot be written.
void write_state(const std::filesystem::path& file, const Simulation& simulation,
                 const std::string& provenance_json);

/// Whether a file is byte for byte as write_state wrote it, by the fingerprint at its end. Also
/// false if there is no such file, or for states of earlier versions.
bool is_as_written(const std::filesystem::path& file);

/// `Simulation(state.setup, state.checkpoint)` then resumes bit for bit.
/// @throws base::InputError  no such file, not a repose state, truncated, edited, or inconsistent.
SavedState read_state(const std::filesystem::path& file);

/// The times of a film's frames so far.
struct Film {
  std::vector<double> times_s;
  double start_s = 0;  ///< start of the current simulation, in film time
  double last_s = 0;   ///< simulation time of the last frame
};

/// A film of a run: frame_00001.vtp, ... (state files) and trajectory.pvd, which ParaView opens as
/// a time series. The files are complete at any moment.
class TrajectoryWriter {
 public:
  /// Creates the folder if missing. `film`: state of a writer to resume.
  /// @throws base::InputError  interval_s is not above 0, or the folder cannot be created.
  TrajectoryWriter(std::filesystem::path folder, double interval_s, std::string provenance_json,
                   Film film = {});

  /// Writes a frame. A simulation that starts from time 0 again follows `interval_s` after the
  /// previous one.
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

/// The frames listed in a trajectory.pvd, in its order; the state files are not opened.
/// @throws base::InputError  no such file, not a collection, or one without frames.
std::vector<TrajectoryFrame> read_trajectory(const std::filesystem::path& file);

}  // namespace repose::dem
