#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 2;

/// What that version gives for the small runs of the test: a fingerprint of all their readings.
inline constexpr std::string_view kSimulatorReadings = "9aa26ac1-5fc0-5b89-b1d4-62f41aaa93b6";

}  // namespace repose::calibrate
