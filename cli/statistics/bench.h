#pragma once

#include <string>
#include <vector>

#include "cli/common/output.h"

namespace repose::cli {

/// What `repose bench` is asked to do, as typed.
struct BenchArguments {
  std::string test;
  std::vector<std::string> files;
  std::vector<std::string> settings;  ///< NAME=VALUE or NAME=VALUE,VALUE,...
  std::string json_file;
};

/// Carries out `repose bench`.
ExitCode run_bench(const BenchArguments& arguments);

}  // namespace repose::cli
