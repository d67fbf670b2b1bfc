#pragma once

namespace repose::calibrate {

/// Version of what makes a run: the engine, the experiments, how a heap is drawn and how the
/// picture is measured. Runs of other versions are not reused. Must be raised whenever the results
/// of a simulation change; a test (SimulatorVersion) enforces it.
inline constexpr int kSimulatorVersion = 12;

}  // namespace repose::calibrate
