#include "calibrate/fit/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <fmt/core.h>

#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/hotelling.h"
#include "calibrate/fit/reading_correlation.h"
#include "calibrate/fit/residuals.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr std::uint64_t kSeedsPerSet = 1'000'000;
constexpr double kCheapFraction = .25;  // of the time that the dearest experiment's repeats take
constexpr int kMostRepeats = 30;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Cheap experiments are repeated as often as hardly lengthens the check.
int repeats_of(const Experiment& experiment, double dearest_s, int repeats) {
  if (!experiment.is_stochastic) return 1;
  const double affordable = kCheapFraction * repeats * dearest_s / experiment.run_s;
  const int most = std::max(kMostRepeats, repeats);
  return affordable < most ? std::max(static_cast<int>(affordable), repeats) : most;
}

/// Everything about one observable but whether it disagrees: that depends on the others, too.
Agreement compared(const Observable& observable, const CheckSample& sample,
                   const UncertainMean& simulated, double measured_uncertainty, double level) {
  const double measured_df = observable.sd ? observable.n - 1 : kInfinite;
  const UncertainMean difference =
      difference_of(simulated, {observable.mean, measured_uncertainty, measured_df});
  Agreement agreement{.observable = observable.name,
                      .measured = observable.mean,
                      .measured_uncertainty = measured_uncertainty,
                      .simulated = simulated.value,
                      .simulated_uncertainty = simulated.uncertainty,
                      .difference_sigma = difference.value / difference.uncertainty,
                      .chance = kNone,
                      .tolerance = tolerance_of(observable, measured_uncertainty),
                      .difference = {kNone, kNone},
                      .detectable = kNone,
                      .runs_to_decide = {},
                      .verdict = AgreementVerdict::cannot_tell,
                      .runs = sample.count(),
                      .failed_runs = sample.failed};
  if (!std::isfinite(agreement.difference_sigma)) return agreement;
  agreement.chance = chance_of(difference);
  agreement.difference = not_ruled_out(difference);
  agreement.detectable = detectable_difference(difference, level);
  const bool is_within = agreement.difference.low >= -agreement.tolerance &&
                         agreement.difference.high <= agreement.tolerance;
  // A set that gives no reading now and then is not what the bench has.
  if (is_within && sample.failed == 0) agreement.verdict = AgreementVerdict::agrees;
  agreement.runs_to_decide =
      runs_to_decide(difference, measured_uncertainty, sample.count(), agreement.tolerance, level);
  return agreement;
}

bool gives_nothing(const Agreement& agreement) {
  return agreement.runs == 0 && agreement.failed_runs > 0;
}

/// Those that differ too much by themselves, at 5 % over all of them (Bonferroni), and only where
/// all together do: so that one and all never contradict each other.
void find_disagreement(Verification& verification, double level) {
  for (Agreement& agreement : verification.observables) {
    const bool is_found = verification.chance < kLevel && agreement.chance < level;
    const bool is_open = agreement.verdict == AgreementVerdict::cannot_tell;
    if ((is_open && is_found) || gives_nothing(agreement)) {
      agreement.verdict = AgreementVerdict::disagrees;
    }
    if (agreement.verdict != AgreementVerdict::cannot_tell) agreement.runs_to_decide.reset();
  }
}

AgreementVerdict verdict_of(const Verification& verification) {
  const std::vector<Agreement>& all = verification.observables;
  if (std::all_of(all.begin(), all.end(), [](const Agreement& agreement) {
        return agreement.verdict == AgreementVerdict::agrees;
      })) {
    return AgreementVerdict::agrees;
  }
  const bool is_seen = verification.chance < kLevel;
  return is_seen || std::any_of(all.begin(), all.end(), gives_nothing)
             ? AgreementVerdict::disagrees
             : AgreementVerdict::cannot_tell;
}

/// The readings of one experiment together; those that no run has left out.
std::optional<ExperimentChance> chance_together(const Problem& problem,
                                                const std::vector<std::size_t>& own,
                                                const std::vector<Agreement>& observables,
                                                const std::vector<UncertainMean>& simulated,
                                                const JointFit* fit) {
  std::vector<std::size_t> there;
  for (const std::size_t i : own) {
    if (std::isfinite(observables[i].chance)) there.push_back(i);
  }
  if (there.empty()) return std::nullopt;
  if (there.size() == 1) return ExperimentChance{observables[there.front()].chance, 1};
  const auto count = static_cast<Eigen::Index>(there.size());
  Eigen::VectorXd differences(count);
  MeanCovariance runs{Eigen::MatrixXd(count, count), kInfinite};
  MeanCovariance bench = runs;
  for (Eigen::Index a = 0; a < count; ++a) {
    const std::size_t i = there[static_cast<std::size_t>(a)];
    const Observable& one = problem.observables[i];
    differences(a) = observables[i].simulated - observables[i].measured;
    if (simulated[i].uncertainty > 0) runs.df = std::min(runs.df, simulated[i].df);
    if (one.sd) bench.df = std::min<double>(bench.df, one.n - 1);
    for (Eigen::Index b = 0; b < count; ++b) {
      const std::size_t k = there[static_cast<std::size_t>(b)];
      const double alike = i == k ? 1 : fit == nullptr ? 0 : fit->reading_correlation[i][k];
      runs.matrix(a, b) = alike * simulated[i].uncertainty * simulated[k].uncertainty;
      bench.matrix(a, b) = alike * shared_readings(one.n, problem.observables[k].n) *
                           observables[i].measured_uncertainty *
                           observables[k].measured_uncertainty;
    }
  }
  return ExperimentChance{chance_of(differences, runs, bench), static_cast<int>(count)};
}

/// Of the experiments with a reading.
double joint_chance_of(const Problem& problem, const std::vector<Agreement>& observables,
                       const std::vector<UncertainMean>& simulated, const JointFit* fit) {
  std::vector<ExperimentChance> experiments;
  for (const std::vector<std::size_t>& own : by_experiment(problem)) {
    const auto chance = chance_together(problem, own, observables, simulated, fit);
    if (chance) experiments.push_back(*chance);
  }
  return experiments.empty() ? kNone : joint_chance(experiments);
}

}  // namespace

std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set) {
  require_sound(problem);
  if (values.size() != problem.parameters.size() || repeats < 2 || set < 0) {
    throw std::invalid_argument(
        fmt::format("verification of {} values for {} parameters, {} repeats, set {}. Fix: a value "
                    "each, 2 repeats or more, sets from 0",
                    values.size(), problem.parameters.size(), repeats, set));
  }
  const std::vector<Experiment> experiments = measured_experiments(problem);
  double dearest_s = 0;
  for (const Experiment& experiment : experiments) {
    dearest_s = std::max(dearest_s, experiment.run_s);
  }
  std::vector<Job> jobs;
  for (const Experiment& experiment : experiments) {
    for (int k = 0; k < repeats_of(experiment, dearest_s, repeats); ++k) {
      const std::uint64_t seed = problem.settings.seed + kFirstCheckSeed +
                                 kSeedsPerSet * static_cast<std::uint64_t>(set) +
                                 static_cast<std::uint64_t>(k);
      jobs.push_back(job_at(problem, experiment, to_unit(problem, values), seed));
    }
  }
  return jobs;
}

Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit) {
  require_sound(problem);
  Verification verification{.values = values, .observables = {}};
  const double level = kLevel / static_cast<double>(problem.observables.size());
  std::vector<UncertainMean> simulated;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const Observable& observable = problem.observables[i];
    const bool is_stochastic = experiment_named(problem, observable.experiment).is_stochastic;
    const CheckSample sample = check_sample(problem, values, observable, runs);
    simulated.push_back(mean_of(sample, is_stochastic, fit, i));
    verification.observables.push_back(
        compared(observable, sample, simulated.back(),
                 fit != nullptr ? fit->observables[i].measured_uncertainty
                                : with_systematic(observable, standard_uncertainty(observable)),
                 level));
  }
  verification.chance = joint_chance_of(problem, verification.observables, simulated, fit);
  find_disagreement(verification, level);
  verification.verdict = verdict_of(verification);
  return verification;
}

}  // namespace repose::calibrate
