#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose compare`, as typed. "A,B" has a value for each picture; a single value
/// applies to both.
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

/// Runs `repose compare`.
ExitCode run_compare(const CompareArguments& arguments);

}  // namespace repose::cli
