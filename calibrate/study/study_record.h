#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/study/study_problem.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// What a picture of a bench's heap gave.
struct PictureReading {
  std::filesystem::path file;
  std::string status;  ///< "ok", "flagged" or "refused"; see counts_in_mean
  std::optional<double> angle_deg;
  std::string reason;  ///< why there is none
};

/// What a study folder is about: enough to know, from the folder alone, what was sought, of what,
/// and how.
struct StudyRecord {
  dem::Study study;  ///< as simulated: heaps softened as the budget says, pictures measured
  dem::ClumpFile grain;
  std::vector<std::string> settings;  ///< laid over the study file
  std::string method;                 ///< "joint" or "paper"
  Budget budget;
  std::vector<PictureReading> pictures;
};

/// The study as simulated, from the study as read: the pictures' angles are its measured values,
/// and its heaps as soft as the budget says.
dem::Study as_simulated(dem::Study study, const Budget& budget,
                        const std::vector<PictureReading>& pictures);

/// Writes FOLDER/study.toml (a copy), clump.json and study.json. The study's file must be there.
/// @throws std::invalid_argument  they cannot be written.
void write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// Reads them back. Scans and pictures that the study names need not be there any more.
/// @throws std::invalid_argument  the folder is none of a study, or a file is damaged.
StudyRecord read_study_record(const std::filesystem::path& folder);

}  // namespace repose::calibrate
