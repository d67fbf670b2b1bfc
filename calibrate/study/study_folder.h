#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/study/study_record.h"

/// The folder that a study is calibrated in, and what is in it beside the store of runs.
namespace repose::calibrate {

inline constexpr const char* kStudyCopy = "study.toml";
inline constexpr const char* kClumpCopy = "clump.json";
inline constexpr const char* kNotesFile = "study.json";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kHeapFile = "heap.vtp";
/// The simulated heaps of the last check.
inline constexpr const char* kHeapsFolder = "heaps";

/// The names above that a folder has, and that no repose wrote there: all of them in a folder that
/// was never a study's. A copy of the study itself is not among them.
std::vector<std::string> foreign_files(const std::filesystem::path& folder,
                                       const std::filesystem::path& study);

}  // namespace repose::calibrate
