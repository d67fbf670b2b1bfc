#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/report/json_view.h"

/// What `repose calibrate --out` left, as far as a report shows it.
namespace repose::calibrate::report {

/// A simulation that was kept.
struct SavedRun {
  std::string experiment;
  std::map<std::string, double> values;  ///< of the coefficients, by full name
  std::map<std::string, double> readings;
  std::string failure;  ///< empty: there are readings
};

/// A number that the bench measured.
struct MeasuredNumber {
  std::string name;        ///< "heap", "heap.base_radius_mm"
  std::string experiment;  ///< "heap"
  std::string reading;     ///< "value", "base_radius_mm"
  std::string unit;
  std::optional<double> measured;
  std::optional<double> uncertainty;  ///< standard uncertainty of the mean
};

/// A picture of a heap on the bench.
struct BenchPicture {
  std::filesystem::path file;
  std::string status;  ///< as it was measured for the study: ok, flagged, refused
  std::optional<double> angle_deg;
};

struct StudyFolder {
  std::filesystem::path folder;
  JsonView study;                 ///< study.json
  JsonView result;                ///< result.json, when it is this study's; else empty
  bool has_other_result = false;  ///< there is a result.json, of other settings
  std::vector<SavedRun> runs;     ///< of the result, else all that were kept
  std::vector<MeasuredNumber> measured;
  std::vector<BenchPicture> pictures;

  bool is_finished() const { return result.exists(); }
  bool is_paper_way() const;
  /// "study.toml" and its hash, from either file.
  JsonView named_study() const;
};

/// @throws std::invalid_argument  no such folder, no study in it, or a damaged file.
StudyFolder read_study_folder(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
