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

/// Where an unfinished run stood, but for the state of its simulation.
struct RestartRecord {
  dem::RunProgress progress;
  dem::Film film;
  std::optional<double> trajectory_s;  ///< between the film's frames; none: it has no film
  double wall_s = 0;                   ///< spent so far
};

/// What a restart file holds beside the state, as JSON in the state's provenance. `stages`: of the
/// experiment.
std::string restart_text(const std::string& description, const RestartRecord& record,
                         std::span<const std::string_view> stages);
/// @throws base::InputError  the text is damaged or of a run with another description; says
/// what is wrong.
RestartRecord restart_in(const std::string& text, const std::string& description,
                         std::span<const std::string_view> stages);

struct SavedRestart {
  dem::Restart from;
  RestartRecord record;
};

/// What keeps runs cannot be used as it is: no fault of what is to be simulated.
struct StoreError : base::InputError {
  using InputError::InputError;
};

/// Runs on disk, files each: FOLDER/runs/KEY.json is what it gave, KEY.vtp its final state,
/// KEY.restart.vtp where an unfinished one stood. Each is there whole or not at all, so that a kill
/// loses no more than what is being simulated. Keys say what was simulated, not for which study:
/// runs are found again by any command and study that asks for the same.
class RunStore {
 public:
  /// @throws base::InputError  the folder cannot be made or written.
  explicit RunStore(std::filesystem::path folder);

  std::filesystem::path runs() const { return folder_ / "runs"; }

  /// None when it was not saved; a file that is damaged (see remarks()) or of something else counts
  /// as not saved, and is overwritten when the run has been made again. Its views may be of another
  /// number than asked for.
  std::optional<RunResult> find(const RunSpec& spec, std::uint64_t seed) const;

  /// The same, but none when something is missing that was asked for: its pictures.
  std::optional<RunResult> find_whole(const RunSpec& spec, std::uint64_t seed) const;

  /// @throws base::InputError  it cannot be written; what was saved before stays.
  void save(const RunSpec& spec, const RunResult& run) const;

  /// What was found damaged so far and counts as not saved ("FILE: what ..."), and what was noted
  /// by others; sorted.
  std::vector<std::string> remarks() const;
  /// What somebody must be told of a run. Any thread may note something.
  void note(const std::string& line) const;

  std::filesystem::path state_file(const RunSpec& spec, std::uint64_t seed) const;
  /// Whether it is there and as it was written.
  bool has_state(const RunSpec& spec, std::uint64_t seed) const;
  /// Copies the final state of a run to FOLDER/NAME, over an older one; false when has_state is.
  /// @throws base::InputError  it cannot be written.
  bool copy_state(const RunSpec& spec, std::uint64_t seed, const std::string& name) const;

  /// Where another program makes the run; not there else, but after one that failed.
  std::filesystem::path work_folder(const RunSpec& spec, std::uint64_t seed) const;

  bool has_restart(const RunSpec& spec, std::uint64_t seed) const;
  /// None when the run was not begun.
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

/// Whether a folder is one that repose has simulated into, of this version or an earlier one.
bool is_run_store(const std::filesystem::path& folder);

/// Whether it has a restart point of any run.
bool has_unfinished_runs(const std::filesystem::path& folder);

/// The file whose lock a process has that writes into the folder: FOLDER/runs/.lock.
std::filesystem::path lock_file_in(const std::filesystem::path& folder);

}  // namespace repose::calibrate
