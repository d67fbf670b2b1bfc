#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// What the folder of `repose calibrate --out` has to say, half-finished or not. Photographs that
/// the study names are measured again, and those that are gone are said. The same folder and
/// photographs give the same bytes.
/// @throws std::invalid_argument  no such folder, no study in it, or a damaged file.
Report study_report(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
