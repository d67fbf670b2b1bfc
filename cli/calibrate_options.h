#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/study/study_problem.h"
#include "cli/calibrate.h"
#include "dem/shape/clump_file.h"
#include "dem/study/study.h"

namespace repose::cli {

/// What `repose calibrate` will do.
struct CalibratePlan {
  dem::Study study;  ///< its heaps softened as the budget says, pictures measured
  dem::ClumpFile grain;
  std::string method;  ///< "joint" or "paper"
  calibrate::Budget budget;
  calibrate::StudyProblem problem;
  std::vector<std::string> settings;
  int jobs = 1;
  std::filesystem::path out_folder;
  std::string json_file;

  std::vector<std::string> faults;  ///< empty: it can be carried out
  std::vector<std::string> notes;   ///< for the user to know
};

CalibratePlan plan_calibrate(const CalibrateArguments& arguments);

}  // namespace repose::cli
