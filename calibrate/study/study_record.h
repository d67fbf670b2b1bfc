#pragma once

#include <filesystem>
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

/// The folder that a study is calibrated in, and what is in it beside the store of runs.
namespace repose::calibrate {

inline constexpr const char* kStudyCopy = "study.toml";
inline constexpr const char* kClumpCopy = "clump.json";
inline constexpr const char* kNotesFile = "study.json";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kHeapFile = "heap.vtp";
/// The simulated heaps of the last check.
inline constexpr const char* kHeapsFolder = "heaps";

/// Which study it is, and how it is calibrated.
struct StudyIdentity {
  std::string program;                ///< that wrote it
  std::string file;                   ///< of the study, without its folder
  std::string hash;                   ///< of its text and settings
  std::vector<std::string> settings;  ///< laid over the study file
  std::string method;                 ///< "joint" or "paper"
  std::string budget;
  std::string budget_description;
  /// Some of its runs may be coarse ones; none: it has no experiment of which any could be.
  std::optional<bool> is_mixed = {};
};

/// The same study, settings, method, budget and kinds of runs, whichever version of the program
/// wrote it.
bool is_same_study(const StudyIdentity& one, const StudyIdentity& other);

/// What FOLDER/study.json holds.
struct StudyNotes {
  StudyIdentity study;
  Measurement measurement;
  /// Of study.toml and clump.json, by name; those of earlier versions have none.
  std::map<std::string, std::string> fingerprints;
  /// What a budget of minutes was found to allow; none of one that its name says all of.
  std::optional<Budget> limits = {};
};

/// What a study folder is about: enough to know, from the folder alone, what was sought, of what,
/// and how.
struct StudyRecord {
  /// As measured: sheets read, pictures and films measured.
  dem::Study study;
  dem::ClumpFile grain;
  std::vector<std::string> settings;  ///< laid over the study file
  std::string method;                 ///< "joint" or "paper"
  Budget budget;
  Measurement measurement;
  std::shared_ptr<const Simulator> simulator = own_simulator();  ///< that makes the runs
  std::vector<std::string> simulator_differences = {};           ///< from ours, a sentence each
};

StudyIdentity identity_of(const StudyRecord& record);

/// Writes copies into the folder, and then study.json with their fingerprints.
/// @throws base::InputError  they cannot be written.
void write_study_files(const std::filesystem::path& folder, StudyNotes notes,
                       const std::map<std::string, std::string>& copies);

/// Writes FOLDER/study.toml (a copy), clump.json and study.json. The study's file must be there.
/// @throws base::InputError  they cannot be written.
void write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// FOLDER/study.json alone. None where there is no such file.
/// @throws base::InputError  it is damaged.
std::optional<StudyNotes> read_study_notes(const std::filesystem::path& folder);

/// Reads them back. Scans and pictures that the study names need not be there any more.
/// @throws base::InputError  the folder is none of a study, a file is damaged, or they do not
/// belong together.
StudyRecord read_study_record(const std::filesystem::path& folder);

/// The names above that a folder has, and that no repose wrote there: all of them in a folder that
/// was never a study's. A copy of the study itself is not among them.
std::vector<std::string> foreign_files(const std::filesystem::path& folder,
                                       const std::filesystem::path& study);

}  // namespace repose::calibrate
