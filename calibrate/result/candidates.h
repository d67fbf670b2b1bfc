#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// Which of several ways to simulate the same bench explains its readings best: rolling models,
/// each fitted by itself.
///
/// Each is given a score of what speaks against it, the sum of two parts: what all means together
/// lack, and how much more single readings scatter than the bench's. Candidates fit the same
/// readings with as many coefficients, so that their scores can be compared as they are. It is not
/// a likelihood, but a sum of two statistics that chi-squares are taken for. Formulae and
/// reasons: calibrate/fit/THEORY.md, "Candidates". Proved by Candidates.* in tests/calibrate.
namespace repose::calibrate {

/// A difference of scores from which on the evidence is taken for strong, as one of deviances
/// would be: Kass and Raftery (1995), J. Am.
/// Stat. Assoc. 90, 773.
inline constexpr double kStrongEvidence = 6;

/// @param name  what it differs by from the others: "elastic_plastic"
Candidate candidate_of(const std::string& name, const JointResult& joint);

/// Infinite where an experiment gives no reading at all.
double candidate_score(const Candidate& candidate);

/// The place of the one that the evidence for is strong, against each of the others. None: it
/// cannot be told.
std::optional<std::size_t> preferred(const std::vector<Candidate>& candidates);

/// What can be said of at least two candidates, a sentence without its full stop.
std::string candidates_text(const std::vector<Candidate>& candidates);

}  // namespace repose::calibrate
