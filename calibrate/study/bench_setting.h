#pragma once

#include <string_view>

#include "dem/study/experiment_table.h"

/// Readings count for an experiment only where the bench was set as the study says.
namespace repose::calibrate {

/// A height or slope measured anew for each reading differs a little from the one that was set.
inline constexpr double kSameSetting = .01;

/// What the protocol has for a key of a study file, in its unit.
double protocol_value(const dem::ExperimentEntry& entry, dem::Protocol protocol,
                      std::string_view key);

}  // namespace repose::calibrate
