#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// What `repose compare` is asked to do, as typed. "A,B" holds a value for each picture; one alone
/// holds for both.
struct CompareArguments {
  std::vector<std::string> pictures;
  std::string mm_per_px;  ///< A,B
  std::string base_mm;    ///< A,B
  std::string grain_mm;
  std::string margin_deg;
  std::string camera_mm;  ///< DISTANCE,HEIGHT
  std::string method;
  std::string window;
  std::string definition;
  std::string pitch_deg;  ///< A,B
  std::vector<std::string> exclude_first;
  std::vector<std::string> exclude_second;
  std::string overlay_file;
  std::string json_file;
  bool groups_by_name = false;
};

/// Carries out `repose compare`.
ExitCode run_compare(const CompareArguments& arguments);

}  // namespace repose::cli
