#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/experiment/run_spec.h"
#include "dem/experiment/experiment.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {

/// The progress of an unfinished run, without the state of its simulation.
struct RestartRecord {
  dem::RunProgress progress;
  dem::Film film;
  std::optional<double> trajectory_s;  ///< between the film's frames; std::nullopt: no film
  double wall_s = 0;                   ///< spent so far
};

/// What a restart file holds besides the state, as JSON in the state's provenance. `stages`: those
/// of the experiment.
std::string restart_text(const std::string& description, const RestartRecord& record,
                         std::span<const std::string_view> stages);
/// @throws base::InputError  the text is damaged or belongs to a run with another description; says
///   what is wrong.
RestartRecord restart_in(const std::string& text, const std::string& description,
                         std::span<const std::string_view> stages);

struct SavedRestart {
  dem::Restart from;
  RestartRecord record;
};

/// The run store cannot be used in its current state; the simulation itself is not at fault.
struct StoreError : base::InputError {
  using InputError::InputError;
};

/// Runs on disk: FOLDER/runs/KEY.json is a run's result, KEY.vtp its final state, KEY.restart.vtp
/// its restart point while unfinished. Files are written atomically, so a kill loses only what is
/// being simulated. Keys identify what was simulated, not the study: any command and study that
/// needs the same run finds it.
class RunStore {
 public:
  /// @throws base::InputError  the folder cannot be made or written.
  explicit RunStore(std::filesystem::path folder);

  std::filesystem::path runs() const { return folder_ / "runs"; }

  /// std::nullopt if it was not saved; a damaged file (see remarks()) or one of something else
  /// counts as not saved, and is overwritten once the run has been made again. The number of views
  /// may differ from that requested.
  std::optional<RunResult> find(const RunSpec& spec, std::uint64_t seed) const;

  /// The same, but std::nullopt if the requested pictures are missing.
  std::optional<RunResult> find_whole(const RunSpec& spec, std::uint64_t seed) const;

  /// @throws base::InputError  it cannot be written; what was saved before remains.
  void save(const RunSpec& spec, const RunResult& run) const;

  /// Files found damaged so far, which count as not saved ("FILE: what ..."), and notes by others;
  /// sorted.
  std::vector<std::string> remarks() const;
  /// Adds a remark on a run for the user; thread-safe.
  void note(const std::string& line) const;

  std::filesystem::path state_file(const RunSpec& spec, std::uint64_t seed) const;
  /// Whether it exists and is unchanged.
  bool has_state(const RunSpec& spec, std::uint64_t seed) const;
  /// Copies the final state of a run to FOLDER/NAME, over an older one; false if has_state() is
  /// false.
  /// @throws base::InputError  it cannot be written.
  bool copy_state(const RunSpec& spec, std::uint64_t seed, const std::string& name) const;

  /// Where another program makes the run; exists only during the run, or after a failed one.
  std::filesystem::path work_folder(const RunSpec& spec, std::uint64_t seed) const;

  bool has_restart(const RunSpec& spec, std::uint64_t seed) const;
  /// std::nullopt if the run was not started.
  /// @throws base::InputError  the file was changed, or belongs to another run.
  std::optional<SavedRestart> find_restart(const RunSpec& spec, std::uint64_t seed) const;
  void save_restart(const RunSpec& spec, std::uint64_t seed, const dem::Simulation& simulation,
                    const RestartRecord& record) const;
  void remove_restart(const RunSpec& spec, std::uint64_t seed) const;

 private:
  std::filesystem::path file(const RunSpec& spec, std::uint64_t seed, const char* ending) const;

  void note_damaged(const std::filesystem::path& file, const std::string& reason) const;

  struct Remarks;
  std::filesystem::path folder_;
  std::shared_ptr<Remarks> remarks_;
};

/// Whether repose, of this or an earlier version, has saved simulations in the folder.
bool is_run_store(const std::filesystem::path& folder);

/// Whether it has a restart point for any run.
bool has_unfinished_runs(const std::filesystem::path& folder);

/// The file that a process locks while it writes into the folder: FOLDER/runs/.lock.
std::filesystem::path lock_file_in(const std::filesystem::path& folder);

}  // namespace repose::calibrate
