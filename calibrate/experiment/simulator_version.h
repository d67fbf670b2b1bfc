#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 6;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "f3e96fd3-9912-5439-ba94-0c3bd8c5b262";
inline constexpr std::string_view kOtherReadings = "db15515c-7d3d-572d-a8b0-008c54a947ea";

}  // namespace repose::calibrate
