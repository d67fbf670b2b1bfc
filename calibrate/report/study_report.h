#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// A study as a page to be read, sent and printed.
namespace repose::calibrate::report {

/// A table as a file.
struct CsvFile {
  std::string name;  ///< without folder: "coefficients.csv"
  std::string text;
};

struct Report {
  std::string html;             ///< one file that needs no other and no network
  std::vector<CsvFile> tables;  ///< what its charts and tables are drawn from
};

/// What a finished study found, with what else there is to be shown.
/// @param pictures  of the bench's heaps, as in StudyRecord; measured again
/// @param heap      state of the simulated one, as RunStore::copy_state() writes it; empty: none
Report study_report(const StudyResult& result, const std::vector<PictureReading>& pictures = {},
                    const std::filesystem::path& heap = {});

/// What the folder of `repose calibrate --out` has to say, half-finished or not. Photographs that
/// the study names are measured again, and those that are gone are said. The same folder and
/// photographs give the same bytes.
/// @throws base::InputError  no such folder, no study in it, or a damaged file.
Report study_report(const std::filesystem::path& folder);

/// Writes the tables into a folder and then the page, each file whole or not at all.
/// @param tables  empty: none are written
/// @param is_ours  the folder of the tables is nobody else's: what an earlier version wrote there
///   and did not list is replaced
/// @throws base::InputError  a file cannot be written, or one there would be lost that was changed.
void write_report(const Report& report, const std::filesystem::path& page,
                  const std::filesystem::path& tables, bool is_ours);

/// Writes FOLDER/report.html, and what its charts are drawn from as FOLDER/tables/*.csv.
/// @return  the page
/// @throws base::InputError  as study_report() and the above; or the page there is somebody's.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
