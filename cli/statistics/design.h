#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose design`, as typed.
struct DesignArguments {
  std::string kind;
  std::vector<std::string> factors;  ///< NAME=MIN:MAX
  std::string alpha;                 ///< rotatable, orthogonal, face or a number
  std::string centre_runs;
  bool is_inscribed = false;
  std::string runs;
  std::string levels;
  std::string seed;
  std::vector<std::string> starts;  ///< NAME=NUMBER
  std::vector<std::string> steps;   ///< NAME=NUMBER
  std::string fitted_table;
  std::string response;
  std::string stride;
  bool descends = false;
  std::string random_order;  ///< seed
  bool with_coded = false;
  std::string out_file;
};

/// Runs `repose design`.
ExitCode run_design(const DesignArguments& arguments);

}  // namespace repose::cli
