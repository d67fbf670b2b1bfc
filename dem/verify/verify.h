#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace repose::dem {

/// One number that the engine must reproduce, at one time step.
struct CaseResult {
  std::string name;      ///< of the case
  std::string quantity;  ///< with its unit
  std::string source;    ///< of the expected value
  double expected = 0;
  double measured = 0;
  double tolerance = 0;  ///< on |measured - expected|, in the same unit
  double timestep_s = 0;
  bool holds = false;
};

/// Hears after each case how many of them are done.
using ProgressCallback = std::function<void(std::size_t done, std::size_t count)>;

/// All cases, in the order of the table.
std::vector<std::string> case_names();

/// Runs one case at the longest time step that the program accepts, and at half of it.
/// Throws base::InputError when there is no case of this name.
std::vector<CaseResult> run_case(const std::string& name);

/// Runs all of them.
std::vector<CaseResult> run_cases(const ProgressCallback& progress = {});

}  // namespace repose::dem
