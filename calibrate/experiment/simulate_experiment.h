#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "calibrate/experiment/run_store.h"

namespace repose::calibrate {

/// The film of a run.
struct TrajectoryPlan {
  std::filesystem::path folder;  ///< of its frames; see dem::TrajectoryWriter
  double interval_s = 0;
};

struct SimulateOptions {
  /// Where runs are looked up and saved, unfinished ones too; null: everything is simulated,
  /// nothing saved.
  const RunStore* folder = nullptr;
  /// Save the final state in the folder; that of a pictured experiment is always saved.
  bool saves_state = false;
  std::optional<TrajectoryPlan> trajectory;
  /// Called periodically with the completed fraction, from any thread; false interrupts it.
  std::function<bool(double fraction)> report;
  /// Called periodically with the number of completed grain steps, instead of saving restart
  /// points.
  std::function<void(double clump_steps)> watch_work = {};
};

/// Makes one run: loads it from the folder if it is there, otherwise simulates it from the start or
/// from where it was interrupted; and measures a heap's pictures if they are missing. Used by all
/// commands, so the same spec and seed give the same bytes.
///
/// An experiment without a reading, or one that becomes unstable, gives a run with a failure; if
/// grains make no heap (no_heap_reason), the final state is still saved. A machine that cannot draw
/// gives heaps without views and with a picture_error.
/// @throws dem::Interrupted  `report` asked for it.
/// @throws base::InputError  the protocol cannot be run, a file cannot be written, or a
/// restart file is damaged.
/// @throws std::runtime_error  this machine cannot draw a draw-down, whose readings come only from
///   its picture.
RunResult simulate_experiment(const RunSpec& spec, std::uint64_t seed,
                              const SimulateOptions& options = {});

}  // namespace repose::calibrate
