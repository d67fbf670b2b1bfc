#pragma once

#include <string_view>

namespace repose::calibrate {

/// Which simulator made a run: the engine, the experiments, how a heap is drawn and how the picture
/// is measured. Runs of another version are not taken for those of this one. To be raised whenever
/// what a simulation gives has changed; a test (SimulatorVersion) sees to it.
inline constexpr int kSimulatorVersion = 5;

/// What that version gives for the small runs of the test: a fingerprint of all readings of the
/// usual experiments, and one of those of the others.
inline constexpr std::string_view kSimulatorReadings = "95981088-8b21-50c4-9851-47ba8c53744d";
inline constexpr std::string_view kOtherReadings = "81c39fe5-3024-50fc-bdd9-784563cdc269";

}  // namespace repose::calibrate
