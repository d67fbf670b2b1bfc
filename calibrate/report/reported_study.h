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
  std::string failure;     ///< empty: there are readings
  bool is_coarse = false;  ///< of larger grains than the study's
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

/// Runs of an unfinished study that another program makes.
struct MadeRuns {
  int made = 0;
  int failed = 0;     ///< of these
  int to_make = 0;    ///< that were asked for and are still to be made
  std::string study;  ///< its file, as far as it is known
};

/// All that a report is made of: a result, or the runs of a study that has none yet.
struct ReportedStudy {
  std::filesystem::path folder;        ///< of repose calibrate --out; empty: there is none
  std::optional<StudyRecord> record;   ///< none: no folder, or its copy of the study is damaged
  std::optional<StudyIdentity> study;  ///< none: an unfinished one whose study.json is gone
  std::optional<StudyResult> result;   ///< none: unfinished
  dem::StudyHeading heading;           ///< the study's own title, author, date and note
  bool has_other_result = false;       ///< the folder has a result of other settings
  std::vector<SavedRun> runs;          ///< of the result, else all that were saved
  std::optional<MadeRuns> made;        ///< unfinished, by another program; none: not so
  std::vector<MeasuredNumber> measured;
  std::vector<PictureReading> pictures;  ///< of the bench's heaps
  std::filesystem::path heap;            ///< state of the simulated one; empty: none
  bool has_other_heap = false;           ///< the folder has one, of other coefficients
};

ReportedStudy reported(const StudyResult& result, const std::vector<PictureReading>& pictures,
                       const std::filesystem::path& heap);

/// @throws base::InputError  no such folder, no study in it, or a damaged file.
ReportedStudy read_reported_study(const std::filesystem::path& folder);

}  // namespace repose::calibrate::report
