#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 12;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "760116b8-d7de-5b3d-81b4-4f61497c97dd";
inline constexpr std::string_view kOtherReadings = "f0fa1305-1b13-586d-bad1-a5ac10e6b6a0";

}  // namespace repose::calibrate
