#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 11;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "39ec9dca-9988-5108-b41a-37a82e89a377";
inline constexpr std::string_view kOtherReadings = "fb8bc55b-51d8-5615-ad39-cc5d4bf72672";

}  // namespace repose::calibrate
