#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 4;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "95981088-8b21-50c4-9851-47ba8c53744d";
inline constexpr std::string_view kOtherReadings = "ba96e8d4-1e2e-5770-915e-6cdb13c5ab8b";

}  // namespace repose::calibrate
