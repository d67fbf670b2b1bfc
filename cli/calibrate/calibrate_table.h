#pragma once

#include <string>

#include "calibrate/result/result.h"

namespace repose::cli {

/// Sentences are hard to read in longer lines.
inline constexpr int kWidestText = 100;

/// A coefficient's name in tables: "particle_wall.restitution".
std::string short_name(const std::string& coefficient);

/// For people: coefficients with intervals and verdicts, measured and simulated values, equally
/// good sets, what would determine the rest, and the conditions under which the values hold.
std::string joint_table(const calibrate::JointResult& joint,
                        const calibrate::Provenance& provenance, int columns);

}  // namespace repose::cli
