#pragma once

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 12;

}  // namespace repose::calibrate
