#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"

/// The state of a simulation in a file that ParaView opens and that a run can go on from.
///
/// VTK XML PolyData (.vtp), a point for each grain that is present: orientation (w x y z),
/// velocity, spin, force, torque, angular_momentum, rolling_limit, mass (SI units, world axes),
/// grain (its number) and kind. All else that a run needs (walls, kinds, materials, contacts,
/// grains that have left) is in arrays of the field data. Doubles are kept to the last bit.

namespace repose::dem {

struct SavedState {
  SimulationSetup setup;  ///< for 1 thread: how many computed it does not show in a state
  Checkpoint checkpoint;
  std::string provenance_json;
};

/// The file's text. The same state gives the same bytes.
/// @param provenance_json  where the state comes from; kept as it is. Without zero bytes.
std::string state_text(const Simulation& simulation, const std::string& provenance_json);

/// Writes it whole or not at all.
/// @throws base::InputError  the place cannot be written.
void write_state(const std::filesystem::path& file, const Simulation& simulation,
                 const std::string& provenance_json);

/// Whether a file is to the last byte what write_state once wrote there: its end has a fingerprint
/// of all else. False too where there is no such file, and for states of earlier versions.
bool is_as_written(const std::filesystem::path& file);

/// `Simulation(state.setup, state.checkpoint)` then goes on bit for bit.
/// @throws base::InputError  no such file, no state of repose, cut short, or edited so that it
/// does not hold together.
SavedState read_state(const std::filesystem::path& file);

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
