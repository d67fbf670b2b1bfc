#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 4;

/// What that version gives for the small runs of the test: a fingerprint of all their readings.
inline constexpr std::string_view kSimulatorReadings = "f6840411-4537-5836-8fb1-ea8ec7cee9d9";

}  // namespace repose::calibrate
