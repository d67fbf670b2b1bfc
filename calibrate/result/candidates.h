#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// Which of several ways to simulate the same bench explains its readings best: rolling models,
/// each fitted separately.
///
/// Each gets a score of the evidence against it, the sum of two parts: the misfit of all means
/// together, and the excess of single readings' scatter over the bench's. Candidates fit the same
/// readings with the same number of coefficients, so their scores can be compared directly. The
/// score is not a likelihood, but a sum of two statistics that are approximated as chi-squares.
/// Formulae and reasons: calibrate/fit/THEORY.md, "Candidates". Proved by Candidates.* in
/// tests/calibrate.
namespace repose::calibrate {

/// Minimum difference of scores for strong evidence, as for a difference of deviances: Kass and
/// Raftery (1995), J. Am. Stat. Assoc. 90, 773.
inline constexpr double kStrongEvidence = 6;

/// @param name  what distinguishes it from the others: "elastic_plastic"
Candidate candidate_of(const std::string& name, const JointResult& joint);

/// Infinite if an experiment gives no reading at all.
double candidate_score(const Candidate& candidate);

/// Index of the candidate strongly preferred to each of the others. std::nullopt: undecided.
std::optional<std::size_t> preferred(const std::vector<Candidate>& candidates);

/// The comparison of at least two candidates, as a sentence without its full stop.
std::string candidates_text(const std::vector<Candidate>& candidates);

}  // namespace repose::calibrate
