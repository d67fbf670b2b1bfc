#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 6;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "b71ea379-4aa2-5f45-8144-0a03317e981f";
inline constexpr std::string_view kOtherReadings = "0a0c1e45-f0bd-5693-825f-bbbcfe51cce2";

}  // namespace repose::calibrate
