#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/start/new_study.h"
#include "cli/new/new_study.h"

namespace repose::cli {

/// What `repose new` will write.
struct NewPlan {
  std::filesystem::path file;
  calibrate::NewStudy study;
  std::vector<std::string> errors;  ///< empty: it can be carried out
};

NewPlan plan_new(const NewArguments& arguments);

/// What may be typed after --grains, and after --plate and its like.
std::vector<std::string> grain_names();
std::vector<std::string> plate_names();

}  // namespace repose::cli
