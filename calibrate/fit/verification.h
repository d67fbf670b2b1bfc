#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Seeds of checks begin here; a study never has so many jobs.
inline constexpr std::uint64_t kFirstCheckSeed = 1'000'000'000;

/// An observable as fresh simulations give it.
struct Agreement {
  std::string observable;
  double measured = 0;
  double measured_uncertainty = 0;
  double simulated = 0;              ///< mean of the runs with a reading; NaN without any
  double simulated_uncertainty = 0;  ///< of that mean; 0 for experiments without chance
  double difference_sigma = 0;       ///< (simulated - measured) / both uncertainties; NaN likewise
  /// That it is as large by chance, of which a fit to the same mean follows a part; NaN likewise.
  double chance = 0;
  double tolerance = 0;                             ///< what does not matter
  std::optional<MarginSource> tolerance_from = {};  ///< earlier versions did not say
  Interval difference;  ///< 90 %: what equivalence compares with the tolerance
  /// True difference that is seen in four of five such checks; NaN where the fit follows it.
  double detectable = 0;
  std::optional<int> runs_to_decide;  ///< none: it is decided, or no number of runs does
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
  /// Of the bench; likewise, as if nothing but these became more.
  std::optional<int> readings_to_decide = {};
  int runs = 0;  ///< with a reading
  int failed_runs = 0;
};

/// One set of parameters, checked.
struct Verification {
  std::vector<double> values;
  std::vector<Agreement> observables;  ///< in Problem's order
  double chance = 0;  ///< that all differ so much by chance (joint_chance); NaN without readings
  /// agrees: all observables do. disagrees: `chance` is below 5 %, or an experiment gives no
  /// reading at all.
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
};

/// Jobs at one set of parameters with seeds that propose() never uses, all as stiff as the study:
/// `repeats` of the measured experiment that costs most, more of cheap ones, one of those without
/// chance. `set` tells sets apart.
std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set);

/// Compares the runs of verification_jobs(), among any others, with what was measured. `fit`, where
/// there is one, tells how much single runs scatter better than a handful of repeats does: the
/// larger of both counts; and what the scatter of the measurement was taken to be. `made_by`: the
/// freedom of the fit whose best set this is, made before these runs; what it could follow of the
/// bench's chance is no agreement. Formulae and reasons: THEORY.md, "Verification". Proved by
/// Verification.* and Agreement.* in tests/calibrate.
Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit = nullptr,
                    const Freedom* made_by = nullptr);

/// What a surrogate expected of fresh runs before it knew of them. In the observable's unit.
struct SurrogateCheck {
  std::string observable;
  double predicted = 0;
  double uncertainty = 0;  ///< standard uncertainty of that
  double simulated = 0;    ///< mean of the runs; NaN without any
  double chance = 0;       ///< that it is off by so much by chance; NaN likewise
  /// It is off by more than chance makes it in 5 % of all checks (Bonferroni over the observables),
  /// and by more than half of the uncertainty of measurement: less does not matter.
  bool misses = false;
};

/// The surrogates of a fit against fresh runs at its best values, which it has not seen.
std::vector<SurrogateCheck> check_surrogates(const Problem& problem, const JointFit& fit,
                                             const std::vector<Run>& runs);

}  // namespace repose::calibrate
