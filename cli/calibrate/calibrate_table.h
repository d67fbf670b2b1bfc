#pragma once

#include <string>

#include "calibrate/result/result.h"

namespace repose::cli {

/// Sentences in longer lines are hard to read.
inline constexpr int kWidestText = 100;

/// As tables call a coefficient: "particle_wall.restitution".
std::string short_name(const std::string& coefficient);

/// For people: coefficients with intervals and verdicts, what was measured and simulated, sets that
/// fit as well, what would determine the rest, and what the values belong to.
std::string joint_table(const calibrate::JointResult& joint,
                        const calibrate::Provenance& provenance, int columns);

}  // namespace repose::cli
