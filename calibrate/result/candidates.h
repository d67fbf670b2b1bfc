#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// Which of several ways to simulate the same bench explains its readings best: rolling models,
/// each fitted by itself.
///
/// Each is given a deviance: how much less likely it makes the readings than a simulation that
/// gives exactly their means and scatters no more than they do. Candidates fit the same readings
/// with as many coefficients, so that their deviances can be compared as they are. Formulae and
/// reasons: calibrate/fit/THEORY.md, "Candidates". Proved by Candidates.* in tests/calibrate.
namespace repose::calibrate {

/// A difference of deviances from which on the evidence is strong: Kass and Raftery (1995), J. Am.
/// Stat. Assoc. 90, 773.
inline constexpr double kStrongEvidence = 6;

/// @param name  what it differs by from the others: "elastic_plastic"
Candidate candidate_of(const std::string& name, const JointResult& joint);

/// Infinite where an experiment gives no reading at all.
double deviance_of(const Candidate& candidate);

/// The place of the one that the evidence for is strong, against each of the others. None: it
/// cannot be told.
std::optional<std::size_t> preferred(const std::vector<Candidate>& candidates);

/// What can be said of at least two candidates, a sentence without its full stop.
std::string candidates_text(const std::vector<Candidate>& candidates);

}  // namespace repose::calibrate
