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

/// What another program made of a case.
struct PeerCase {
  std::string name;
  /// As run_case() has them, in the same order; of other programs, whether they hold is no verdict
  /// on them: the tolerances are those of our own engine.
  std::vector<CaseResult> results = {};
  std::string cannot = {};                ///< or why it cannot run it
  std::vector<std::string> changes = {};  ///< values that it took others for, each once
};

/// Hears after each case how many of them are done.
using ProgressCallback = std::function<void(std::size_t done, std::size_t count)>;

/// All cases, in the order of the table.
std::vector<std::string> case_names();

/// Runs one case at the longest time step that the program accepts, and at half of it; `peer`: in
/// another program.
/// @throws base::InputError  there is no case of this name, or the other program failed.
/// @throws CannotRun  the other program cannot run it.
std::vector<CaseResult> run_case(const std::string& name, const CasePeer* peer = nullptr);

/// All of them in another program.
/// @throws base::InputError  it failed.
std::vector<PeerCase> run_cases_in(const CasePeer& peer, const ProgressCallback& progress = {});

/// Runs all of them.
std::vector<CaseResult> run_cases(const ProgressCallback& progress = {});

}  // namespace repose::dem
