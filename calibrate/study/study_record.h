#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/bench/bench_readings.h"
#include "calibrate/experiment/simulator.h"
#include "calibrate/study/study_problem.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

/// The folder that a study is calibrated in, and its contents other than the store of runs.
namespace repose::calibrate {

inline constexpr const char* kStudyCopy = "study.toml";
inline constexpr const char* kClumpCopy = "clump.json";
inline constexpr const char* kNotesFile = "study.json";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kHeapFile = "heap.vtp";
/// The simulated heaps of the last check.
inline constexpr const char* kHeapsFolder = "heaps";

/// Identifies a study and how it is calibrated.
struct StudyIdentity {
  std::string program;                ///< version that wrote it
  std::string file;                   ///< of the study, without its folder
  std::string hash;                   ///< of its text and settings
  std::vector<std::string> settings;  ///< overrides of the study file
  std::string method;                 ///< "joint" or "paper"
  std::string budget;
  std::string budget_description;
  /// Whether some of its runs may be coarse; std::nullopt: no experiment allows coarse runs.
  std::optional<bool> is_mixed = {};
  /// Budget::longest_run_s, saved if it is mixed.
  double longest_run_s = std::numeric_limits<double>::infinity();
};

/// The same study, settings, method, budget and kinds of runs, regardless of the program version
/// that wrote it.
bool is_same_study(const StudyIdentity& one, const StudyIdentity& other);

/// Contents of FOLDER/study.json.
struct StudyNotes {
  StudyIdentity study;
  Measurement measurement;
  /// Of study.toml and clump.json, by name; earlier versions have none.
  std::map<std::string, std::string> fingerprints;
  /// What a budget of minutes was found to allow; std::nullopt if the budget's name says it all.
  std::optional<Budget> limits = {};
};

/// Contents of a study folder: enough to determine from it alone what was sought, of what, and how.
struct StudyRecord {
  /// As measured: sheets read, pictures and films measured.
  dem::Study study;
  dem::ClumpFile grain;
  std::vector<std::string> settings;  ///< overrides of the study file
  std::string method;                 ///< "joint" or "paper"
  Budget budget;
  Measurement measurement;
  std::shared_ptr<const Simulator> simulator = own_simulator();  ///< makes the runs
  std::vector<std::string> simulator_differences = {};           ///< from ours, a sentence each
};

StudyIdentity identity_of(const StudyRecord& record);

/// Writes copies into the folder, then study.json with their fingerprints.
/// @throws base::InputError  they cannot be written.
void write_study_files(const std::filesystem::path& folder, StudyNotes notes,
                       const std::map<std::string, std::string>& copies);

/// Writes FOLDER/study.toml (a copy), clump.json and study.json. The study's file must exist.
/// @throws base::InputError  they cannot be written.
void write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// FOLDER/study.json alone. std::nullopt if there is no such file.
/// @throws base::InputError  it is damaged.
std::optional<StudyNotes> read_study_notes(const std::filesystem::path& folder);

/// Reads them back. Scans and pictures named in the study need not exist any more.
/// @throws base::InputError  the folder is not that of a study, a file is damaged, or they do not
/// belong together.
StudyRecord read_study_record(const std::filesystem::path& folder);

/// The names above that exist in a folder but were not written by repose: all of them in a folder
/// that was never a study's. A copy of the study itself is not included.
std::vector<std::string> foreign_files(const std::filesystem::path& folder,
                                       const std::filesystem::path& study);

}  // namespace repose::calibrate
