#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/result/result.h"
#include "calibrate/study/study_record.h"

namespace repose::calibrate::report {

/// A simulation that was saved.
struct SavedRun {
  std::string experiment;
  std::map<std::string, double> values;  ///< of the coefficients, by full name
  std::map<std::string, double> readings;
  std::string failure;     ///< empty: it has readings
  double grain_size = 1;   ///< as a multiple of the study's
  bool is_coarse = false;  ///< with larger grains than full runs
};

/// A number measured on the bench.
struct MeasuredNumber {
  std::string name;        ///< "heap", "heap.base_radius_mm"
  std::string experiment;  ///< "heap"
  std::string reading;     ///< "value", "base_radius_mm"
  std::string unit;
  std::optional<double> measured;
  std::optional<double> uncertainty;  ///< standard uncertainty of the mean
};

/// Runs of an unfinished study, made by another program.
struct MadeRuns {
  int made = 0;
  int failed = 0;     ///< of these
  int to_make = 0;    ///< planned but not yet made
  std::string study;  ///< its file, if known
};

/// Everything a report is made of: a result, or the runs of a study that has none yet.
struct ReportedStudy {
  std::filesystem::path folder;  ///< of repose calibrate --out; empty: none
  std::optional<StudyRecord>
      record;  ///< std::nullopt: no folder, or its copy of the study is damaged
  std::optional<StudyIdentity> study;  ///< std::nullopt: unfinished, and study.json is missing
  std::optional<StudyResult> result;   ///< std::nullopt: unfinished
  dem::StudyHeading heading;           ///< the study's own title, author, date and note
  bool has_other_result = false;       ///< the folder has a result from other settings
  std::vector<SavedRun> runs;          ///< of the result, otherwise all saved ones
  std::optional<MadeRuns> made;        ///< std::nullopt: finished, or not made by another program
  std::vector<MeasuredNumber> measured;
  std::vector<PictureReading> pictures;  ///< of the bench's heaps
  std::filesystem::path heap;            ///< state of the simulated heap; empty: none
  bool has_other_heap = false;           ///< the folder has a heap of other coefficients
};

ReportedStudy reported(const StudyResult& result, const std::vector<PictureReading>& pictures,
                       const std::filesystem::path& heap);

/// @throws base::InputError  no such folder, no study in it, or a damaged file.
ReportedStudy read_reported_study(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
