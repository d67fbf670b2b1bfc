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
  std::optional<double> timeout_s = {};  ///< of each
  const std::atomic<bool>* is_interrupted = nullptr;
  std::function<void()> report = {};                       ///< a run has ended
  std::function<void(const std::string& text)> note = {};  ///< why one failed, with its last lines
};

/// Makes rows of the table, some at once, begun in their order; each is kept in the table as soon
/// as it has ended. A program that ends badly, or takes too long, makes a failed run. Interrupted,
/// the programs are ended with all that they started, and their rows are still to be made. What
/// comes out does not depend on how many run at once. Proved by OneRunTest.* in tests/calibrate.
/// @return  how many of them failed; none: it was interrupted
/// @throws base::InputError  a run's folder holds somebody's files, or a program that an earlier
///   process started still works there.
std::optional<std::size_t> make_runs(EngineRuns& table, const Engine& engine,
                                     const std::vector<std::size_t>& rows,
                                     const MakeSettings& settings);

/// Mean seconds of the table's runs that did not fail; none: nothing is known.
std::optional<double> mean_run_s(const EngineRuns& table);

}  // namespace repose::calibrate
