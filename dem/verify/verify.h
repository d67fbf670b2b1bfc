#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace repose::dem {

class CasePeer;

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

/// Results of a case in another program.
struct PeerCase {
  std::string name;
  /// As from run_case(), in the same order; whether they hold is not a verdict on the other
  /// program, as the tolerances are for our engine.
  std::vector<CaseResult> results = {};
  std::string cannot = {};                ///< or why it cannot run the case
  std::vector<std::string> changes = {};  ///< values that it replaced, each once
};

/// Called after each case with the number of cases done.
using ProgressCallback = std::function<void(std::size_t done, std::size_t count)>;

/// All cases, in the order of the table.
std::vector<std::string> case_names();

/// Runs one case at the longest accepted time step and at half of it; `peer`: in another program.
/// @throws base::InputError  there is no case of this name, or the other program failed.
/// @throws CannotRun  the other program cannot run it.
std::vector<CaseResult> run_case(const std::string& name, const CasePeer* peer = nullptr);

/// Runs all cases in another program.
/// @throws base::InputError  it failed.
std::vector<PeerCase> run_cases_in(const CasePeer& peer, const ProgressCallback& progress = {});

/// Runs all cases.
std::vector<CaseResult> run_cases(const ProgressCallback& progress = {});

}  // namespace repose::dem
