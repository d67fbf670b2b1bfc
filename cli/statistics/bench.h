#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose bench`, as typed.
struct BenchArguments {
  std::string test;
  std::vector<std::string> files;
  std::vector<std::string> settings;  ///< NAME=VALUE or NAME=VALUE,VALUE,...
  std::string json_file;
};

/// Runs `repose bench`.
ExitCode run_bench(const BenchArguments& arguments);

}  // namespace repose::cli
