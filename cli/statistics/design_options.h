#pragma once

#include <string>
#include <vector>

#include "calibrate/statistics/design/design.h"
#include "cli/statistics/design.h"
#include "cli/statistics/design_csv.h"

namespace repose::cli {

/// A `repose design` that can be carried out.
struct DesignPlan {
  calibrate::Design design;
  DesignCsvOptions csv;
  std::string out_file;  ///< - without --out

  std::vector<std::string> notes;
  std::vector<std::string> errors;  ///< empty: it can be carried out
};

/// Reads and checks all that was typed, and makes the design. All errors at once.
DesignPlan plan_design(const DesignArguments& arguments);

}  // namespace repose::cli
