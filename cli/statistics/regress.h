#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose regress`, as typed.
struct RegressArguments {
  std::string table;
  std::string response;
  std::string factors;  ///< A,B,C
  std::string model;
  std::string blocks;                ///< a column, or "none"
  std::vector<std::string> codings;  ///< NAME=MIN:MAX
  std::string target;
  std::string json_file;
};

/// Runs `repose regress`.
ExitCode run_regress(const RegressArguments& arguments);

}  // namespace repose::cli
