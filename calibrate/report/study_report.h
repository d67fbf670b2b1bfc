#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// A study as a page to read, send and print.
namespace repose::calibrate::report {

/// A table as a file.
struct CsvFile {
  std::string name;  ///< without folder: "coefficients.csv"
  std::string text;
};

struct Report {
  std::string html;             ///< one file that needs no other files and no network
  std::vector<CsvFile> tables;  ///< the data of its charts and tables
};

/// The results of a finished study, with its pictures and heap if given.
/// @param pictures  of the bench's heaps, as in StudyRecord; they are measured again
/// @param heap  state of the simulated heap, as RunStore::copy_state() writes it; empty: none
Report study_report(const StudyResult& result, const std::vector<PictureReading>& pictures = {},
                    const std::filesystem::path& heap = {});

/// The report of a folder of `repose calibrate --out`, finished or not. Photographs that the study
/// names are measured again, and missing ones are mentioned. The same folder and photographs give
/// the same bytes.
/// @throws base::InputError  the folder does not exist, has no study in it, or a file is damaged.
Report study_report(const std::filesystem::path& folder);

/// Writes the tables into a folder and then the page, each file atomically.
/// @param tables  empty: none are written
/// @param is_ours  the tables' folder is repose's own: files that an earlier version wrote there
///   and did not list are replaced
/// @throws base::InputError  a file cannot be written, or a changed file would be overwritten.
void write_report(const Report& report, const std::filesystem::path& page,
                  const std::filesystem::path& tables, bool is_ours);

/// Writes FOLDER/report.html, and the data of its charts as FOLDER/tables/*.csv.
/// @return  the page
/// @throws base::InputError  as study_report() and the above; or the existing page is not repose's.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
