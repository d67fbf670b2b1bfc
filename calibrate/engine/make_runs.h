#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/engine/engine.h"
#include "calibrate/engine/engine_runs.h"

namespace repose::calibrate {

struct MakeSettings {
  int jobs = 1;
  std::optional<double> timeout_s = {};  ///< of each run
  const std::atomic<bool>* is_interrupted = nullptr;
  std::function<void()> report = {};                       ///< called when a run has ended
  std::function<void(const std::string& text)> note = {};  ///< why one failed, with its last lines
};

/// Makes rows of the table, several at once, started in order; each is saved in the table as soon
/// as it ends. A program that fails or takes too long makes a failed run. On interruption the
/// programs are terminated with all their child processes, and their rows remain to be made. The
/// result does not depend on how many run at once. Proved by OneRunTest.* in tests/calibrate.
/// @return  how many of them failed; std::nullopt if interrupted
/// @throws base::InputError  a run's folder holds foreign files, or a program that an earlier
///   process started is still running there.
std::optional<std::size_t> make_runs(EngineRuns& table, const Engine& engine,
                                     const std::vector<std::size_t>& rows,
                                     const MakeSettings& settings);

/// Mean duration [s] of the table's runs that did not fail; std::nullopt if unknown.
std::optional<double> mean_run_s(const EngineRuns& table);

}  // namespace repose::calibrate
