#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "calibrate/experiment/run_store.h"

namespace repose::calibrate {

/// A film of a run.
struct TrajectoryPlan {
  std::filesystem::path folder;  ///< of its frames; see dem::TrajectoryWriter
  double interval_s = 0;
};

struct SimulateOptions {
  /// Where runs are found and saved, also half-way; null: nowhere, all is simulated.
  const RunStore* folder = nullptr;
  /// The folder is to hold the final state; that of a pictured experiment is saved anyway.
  bool saves_state = false;
  std::optional<TrajectoryPlan> trajectory;
  /// Called periodically with the completed fraction, from any thread; false interrupts it.
  std::function<bool(double fraction)> report;
  /// Is told now and then how many grain steps are done, in place of saving the run half-way.
  std::function<void(double clump_steps)> watch_work = {};
};

/// Makes one run: from the folder where it is there, else by simulating it, from the start or from
/// where it was interrupted; and measures the pictures of a heap where those are not there. The one
/// way in which all commands do it: the same spec and seed give the same bytes.
///
/// An experiment in which nothing can be read, or that becomes unstable, is a run with a failure;
/// of grains that make no heap (no_heap_reason) the final state is saved all the same. A machine
/// that cannot draw gives heaps without views and with a picture_error.
/// @throws dem::Interrupted  `report` asked for it.
/// @throws base::InputError  the protocol cannot be run, a file cannot be written, or a
/// restart file is damaged.
/// @throws std::runtime_error  this machine cannot draw a draw-down, which has readings in its
/// picture alone.
RunResult simulate_experiment(const RunSpec& spec, std::uint64_t seed,
                              const SimulateOptions& options = {});

}  // namespace repose::calibrate
