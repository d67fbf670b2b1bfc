#include "calibrate/result/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/distributions.h"

namespace repose::calibrate {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kMinChance = 1e-300;

/// Score of all differences of means: the chi-square that is exceeded with their joint probability.
double score_of_means(const JointResult& joint) {
  for (const ResultObservable& observable : joint.observables) {
    if (!observable.verification || observable.verification->runs == 0) return kUnbounded;
  }
  if (!std::isfinite(joint.agreement.chance)) return kUnbounded;
  const double chance = std::clamp(joint.agreement.chance, kMinChance, 1.);
  constexpr double kFewest = 1e-3;  // degrees of freedom: effectively none
  const auto readings = static_cast<double>(joint.observables.size());
  return base::chi_square_exceeded(chance,
                                   std::max(joint.degrees_of_freedom.value_or(readings), kFewest));
}

/// For two normal samples: likelihood ratio of equal against arbitrary variances (Bartlett 1937,
/// Proc. R. Soc. Lond. A 160, 268, before his correction for few readings). 0 if the bench scatters
/// more, for which it has reasons that are not simulated.
double score_of_scatter(double bench_sd, double bench_df, double simulated_sd,
                        double simulated_df) {
  if (!(bench_sd > 0) || simulated_sd <= bench_sd || bench_df < 1 || simulated_df < 1) return 0;
  const double bench = bench_sd * bench_sd;
  const double simulated = simulated_sd * simulated_sd;
  const double df = bench_df + simulated_df;
  const double pooled = (bench_df * bench + simulated_df * simulated) / df;
  return df * std::log(pooled) - bench_df * std::log(bench) - simulated_df * std::log(simulated);
}

double scores_of_scatter(const JointResult& joint) {
  double sum = 0;
  for (std::size_t k = 0; k < joint.observables.size(); ++k) {
    const ResultObservable& observable = joint.observables[k];
    if (observable.sd_assumed || k >= joint.surrogates.size()) continue;
    if (joint.surrogates[k].full_size != 1) continue;  // larger grains scatter more
    sum += score_of_scatter(observable.measured_sd, bench_readings(observable) - 1,
                            observable.predicted_sd, joint.surrogates[k].scatter_df());
  }
  return sum;
}

}  // namespace

int bench_readings(const ResultObservable& observable) {
  const double of_mean2 =
      std::pow(observable.measured_uncertainty, 2) - std::pow(observable.systematic_uncertainty, 2);
  return static_cast<int>(std::lround(std::pow(observable.measured_sd, 2) / of_mean2));
}

Candidate candidate_of(const std::string& name, const JointResult& joint) {
  Candidate candidate{.name = name,
                      .means = score_of_means(joint),
                      .scatter = scores_of_scatter(joint),
                      .verdict = joint.verdict.value_or(AgreementVerdict::cannot_tell),
                      .values = {}};
  for (const ResultParameter& parameter : joint.parameters) {
    candidate.values.emplace_back(parameter.name, parameter.value);
  }
  return candidate;
}

double candidate_score(const Candidate& candidate) {
  const double sum = candidate.means + candidate.scatter;
  return std::isfinite(sum) ? sum : kUnbounded;
}

std::optional<std::size_t> preferred(const std::vector<Candidate>& candidates) {
  const auto best = std::ranges::min_element(candidates, {}, candidate_score);
  if (best == candidates.end()) return std::nullopt;
  for (auto other = candidates.begin(); other != candidates.end(); ++other) {
    // Also if neither is finite.
    if (other != best && !(candidate_score(*other) - candidate_score(*best) >= kStrongEvidence)) {
      return std::nullopt;
    }
  }
  return static_cast<std::size_t>(best - candidates.begin());
}

std::string candidates_text(const std::vector<Candidate>& candidates) {
  const auto place = preferred(candidates);
  if (!place) {
    return fmt::format(
        "the bench readings do not tell which of them is right: the scores differ by less than "
        "{:g}, or none of them gives all readings",
        kStrongEvidence);
  }
  const Candidate& best = candidates[*place];
  double next = kUnbounded;
  for (const Candidate& other : candidates) {
    if (&other != &best) next = std::min(next, candidate_score(other));
  }
  if (!std::isfinite(next)) {
    return fmt::format("{} is the only one that gives all readings", best.name);
  }
  return fmt::format(
      "{} explains the bench readings best: its score is lower by {:.1f} or more ({:g} is "
      "taken for strong evidence)",
      best.name, next - candidate_score(best), kStrongEvidence);
}

}  // namespace repose::calibrate
