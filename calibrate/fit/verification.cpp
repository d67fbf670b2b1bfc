#include "calibrate/fit/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/core.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/fit/agreement.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/reading_correlation.h"

// Internal to the joint comparison of several means: included by .cpp files only.

namespace repose::calibrate {

namespace {

/// Covariance of the means of several readings, and its degrees of freedom.
struct MeanCovariance {
  Eigen::MatrixXd matrix;
  double df = 0;
};

/// The probability that chance alone makes two vectors of means differ as much, with both scatters
/// unknown: Hotelling's T^2 with the degrees of freedom of Krishnamoorthy and Yu (2004), Stat.
/// Probab. Lett. 66, 161, which are Welch's for a single reading.
double chance_of(const Eigen::VectorXd& difference, const MeanCovariance& one,
                 const MeanCovariance& other) {
  const auto count = static_cast<double>(difference.size());
  const Eigen::LLT<Eigen::MatrixXd> both(one.matrix + other.matrix);
  double spread = 0;
  for (const MeanCovariance* each : {&one, &other}) {
    const Eigen::MatrixXd fraction = both.solve(each->matrix);
    const double trace = fraction.trace();
    spread += ((fraction * fraction).trace() + trace * trace) / each->df;
  }
  const double df = std::min(count * (count + 1) / std::max(spread, 1e-300), base::kManyDf);
  const double t2 = difference.dot(both.solve(difference));
  const double left = std::max(df - count + 1, 1.);
  return base::fisher_f_above(t2 * left / (std::max(df, count) * count), count, left);
}

constexpr std::uint64_t kSeedsPerSet = 1'000'000;
constexpr double kCheapFraction = .25;  // of the time for the most expensive experiment's repeats
constexpr int kMaxRepeats = 30;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Cheap experiments are repeated as often as possible without lengthening the check noticeably.
int repeats_of(const Experiment& experiment, double dearest_s, int repeats) {
  if (!experiment.is_stochastic) return 1;
  const double affordable = kCheapFraction * repeats * dearest_s / experiment.run_s;
  const int most = std::max(kMaxRepeats, repeats);
  return affordable < most ? std::max(static_cast<int>(affordable), repeats) : most;
}

/// Both means of all observables, and the covariance of their differences.
class Differences {
 public:
  Differences(const Problem& problem, const std::vector<UncertainMean>& simulated,
              const std::vector<double>& measured_uncertainty, const JointFit* fit,
              const Freedom* made_by);

  /// As if the bench's mean had not affected what was simulated: used to judge equivalence. Errors
  /// of the model are part of the difference, not of its uncertainty.
  UncertainMean whole(std::size_t i) const { return difference_of(simulated_[i], measured_[i]); }
  /// With its random uncertainty, given that the fit followed part of the bench's errors.
  UncertainMean left(std::size_t i) const;
  /// The fraction of a true difference that the fit does not follow.
  double seen(std::size_t i) const { return kept_(place(i), place(i)); }
  /// Probability that all of these differ so much by chance.
  double chance(const std::vector<std::size_t>& there) const;

 private:
  static Eigen::Index place(std::size_t i) { return static_cast<Eigen::Index>(i); }
  ExperimentChance chance_of_experiment(const std::vector<std::size_t>& there) const;

  const Problem& problem_;
  std::vector<UncertainMean> simulated_;
  std::vector<UncertainMean> measured_;
  Eigen::MatrixXd bench_;   ///< covariance of the measured means
  Eigen::MatrixXd runs_;    ///< of the simulated ones
  Eigen::MatrixXd kept_;    ///< I - H
  Eigen::MatrixXd model_;   ///< of the model's errors
  Eigen::MatrixXd unsure_;  ///< of the differences, from the uncertainty of the fit
};

/// Only the scatter of readings has finitely many degrees of freedom.
UncertainMean bench_mean(const Observable& observable, double uncertainty) {
  const double scatter2 = std::pow(uncertainty, 2) - std::pow(observable.systematic_sd, 2);
  return with_known(
      {observable.mean, std::sqrt(std::max(scatter2, 0.)), degrees_of_scatter(observable)},
      observable.systematic_sd);
}

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows, std::size_t size) {
  const auto count = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    matrix.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), count);
  }
  return matrix;
}

Differences::Differences(const Problem& problem, const std::vector<UncertainMean>& simulated,
                         const std::vector<double>& measured_uncertainty, const JointFit* fit,
                         const Freedom* made_by)
    : problem_(problem), simulated_(simulated) {
  const std::size_t count = problem.observables.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Observable& one = problem.observables[i];
    measured_.push_back(bench_mean(one, measured_uncertainty[i]));
  }
  bench_ = Eigen::MatrixXd::Zero(place(count), place(count));
  runs_ = bench_;
  model_ = bench_;
  for (std::size_t i = 0; i < count; ++i) {
    model_(place(i), place(i)) = std::pow(problem.observables[i].model_sd, 2);
  }
  for (const std::vector<std::size_t>& own : by_experiment(problem)) {
    for (const std::size_t i : own) {
      for (const std::size_t k : own) {
        const bool is_none = i != k && fit == nullptr;
        const double in_runs = i == k ? 1 : is_none ? 0 : fit->reading_correlation[i][k];
        const double on_bench = i == k ? 1 : is_none ? 0 : fit->bench_correlation[i][k];
        runs_(place(i), place(k)) = in_runs * simulated[i].uncertainty * simulated[k].uncertainty;
        bench_(place(i), place(k)) =
            on_bench * shared_readings(problem.observables[i].n, problem.observables[k].n) *
            measured_uncertainty[i] * measured_uncertainty[k];
      }
    }
  }
  const bool is_fitted = made_by != nullptr && !made_by->followed.empty();
  kept_ = Eigen::MatrixXd::Identity(place(count), place(count));
  if (is_fitted) kept_ -= matrix_of(made_by->followed, count);
  unsure_ = matrix_of(is_fitted ? made_by->unsure : std::vector<std::vector<double>>{}, count);
}

UncertainMean Differences::left(std::size_t i) const {
  const double bench2 = (kept_.row(place(i)) * bench_ * kept_.row(place(i)).transpose())(0);
  double spread = 0;
  double own = 0;
  for (std::size_t k = 0; k < measured_.size(); ++k) {
    const double part = kept_(place(i), place(k)) * measured_[k].uncertainty;
    own += part * part;
    spread += std::pow(part, 4) / measured_[k].df;
  }
  const double model2 = (kept_.row(place(i)) * model_ * kept_.row(place(i)).transpose())(0);
  const double bench_df = spread > 0 ? own * own / spread : kInfinite;
  // The fit's own uncertainty is treated as known exactly: it only adds to the variance.
  const double known = std::sqrt(unsure_(place(i), place(i)) + model2);
  return difference_of(simulated_[i],
                       with_known({measured_[i].value, std::sqrt(bench2), bench_df}, known));
}

ExperimentChance Differences::chance_of_experiment(const std::vector<std::size_t>& there) const {
  if (there.size() == 1) {
    const std::size_t i = there.front();
    const double model_sd = problem_.observables[i].model_sd;
    return {chance_of(difference_of(simulated_[i], with_known(measured_[i], model_sd))), 1};
  }
  const Eigen::Index count = place(there.size());
  Eigen::VectorXd differences(count);
  MeanCovariance runs{Eigen::MatrixXd(count, count), kInfinite};
  MeanCovariance bench = runs;
  for (Eigen::Index a = 0; a < count; ++a) {
    const std::size_t i = there[static_cast<std::size_t>(a)];
    differences(a) = simulated_[i].value - measured_[i].value;
    if (simulated_[i].uncertainty > 0) runs.df = std::min(runs.df, simulated_[i].df);
    bench.df = std::min(bench.df, measured_[i].df);
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index k = place(there[static_cast<std::size_t>(b)]);
      runs.matrix(a, b) = runs_(place(i), k);
      bench.matrix(a, b) = bench_(place(i), k) + model_(place(i), k);
    }
  }
  return {chance_of(differences, runs, bench), static_cast<int>(count)};
}

double Differences::chance(const std::vector<std::size_t>& there) const {
  if (there.empty()) return kNone;
  std::vector<ExperimentChance> experiments;
  for (std::vector<std::size_t> own : by_experiment(problem_)) {
    std::erase_if(own, [&](std::size_t i) { return std::ranges::find(there, i) == there.end(); });
    if (!own.empty()) experiments.push_back(chance_of_experiment(own));
  }
  std::vector<Eigen::Index> places;
  for (const std::size_t i : there) places.push_back(place(i));
  const Eigen::MatrixXd assumed = (bench_ + model_ + runs_)(places, places);
  const Eigen::MatrixXd real =
      Eigen::MatrixXd(kept_ * (bench_ + model_) * kept_.transpose() + unsure_)(places, places) +
      Eigen::MatrixXd(runs_(places, places));
  const Eigen::MatrixXd ratio = assumed.llt().solve(real);
  const double mean = ratio.trace();
  const double half_variance = (ratio * ratio).trace();
  return joint_chance(experiments, ScaledChiSquare{.scale = half_variance / mean,
                                                   .df = mean * mean / half_variance});
}

/// Everything about one observable except whether it disagrees, which depends on the others, too.
Agreement compared(const Observable& observable, const CheckSample& sample,
                   const Differences& differences, std::size_t i, double level,
                   const UncertainMean& simulated, double measured_uncertainty,
                   const std::optional<Interval>& possible) {
  constexpr double kFollowed = .05;  // with less left of a true difference, it cannot be seen
  const UncertainMean whole = with_known(differences.whole(i), observable.size_sd);
  const Margin margin = margin_of(observable, possible);
  Agreement agreement{.observable = observable.name,
                      .measured = observable.mean,
                      .measured_uncertainty = measured_uncertainty,
                      .simulated = simulated.value,
                      .simulated_uncertainty = simulated.uncertainty,
                      .difference_sigma = whole.value / whole.uncertainty,
                      .chance = kNone,
                      .tolerance = margin.value,
                      .tolerance_from = margin.source,
                      .difference = {kNone, kNone},
                      .detectable = kNone,
                      .runs_to_decide = {},
                      .verdict = AgreementVerdict::cannot_tell,
                      .runs = sample.count(),
                      .failed_runs = sample.failed};
  if (!std::isfinite(agreement.difference_sigma)) return agreement;
  const UncertainMean left = differences.left(i);
  agreement.chance = chance_of(left);
  agreement.difference = equivalence_interval(whole);
  if (differences.seen(i) > kFollowed) {
    agreement.detectable = detectable_difference(left, level) / differences.seen(i);
  }
  const bool is_within = agreement.difference.low >= -agreement.tolerance &&
                         agreement.difference.high <= agreement.tolerance;
  // A set that fails occasionally does not reproduce the bench.
  if (is_within && sample.failed == 0) agreement.verdict = AgreementVerdict::agrees;
  agreement.runs_to_decide =
      runs_to_decide(whole, measured_uncertainty, sample.count(), agreement.tolerance, level);
  const double by_scatter2 =
      std::pow(measured_uncertainty, 2) - std::pow(observable.systematic_sd, 2);
  agreement.readings_to_decide = readings_to_decide(whole, std::sqrt(std::max(by_scatter2, 0.)),
                                                    observable.n, agreement.tolerance, level);
  return agreement;
}

bool gives_nothing(const Agreement& agreement) {
  return agreement.runs == 0 && agreement.failed_runs > 0;
}

/// Those that differ too much individually, at 5 % over all of them (Bonferroni), and only if all
/// together do: so that the individual and joint verdicts never contradict each other.
void find_disagreement(Verification& verification, double level) {
  for (Agreement& agreement : verification.observables) {
    const bool is_found = verification.chance < kLevel && agreement.chance < level;
    const bool is_open = agreement.verdict == AgreementVerdict::cannot_tell;
    if ((is_open && is_found) || gives_nothing(agreement)) {
      agreement.verdict = AgreementVerdict::disagrees;
    }
    if (agreement.verdict == AgreementVerdict::cannot_tell) continue;
    agreement.runs_to_decide.reset();
    agreement.readings_to_decide.reset();
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

}  // namespace

std::vector<Job> verification_jobs(const Problem& problem, const std::vector<double>& values,
                                   int repeats, int set) {
  require_sound(problem);
  if (values.size() != problem.parameters.size() || repeats < 2 || set < 0) {
    throw base::InputError(
        {.value = fmt::format("verification of {} values for {} parameters, {} repeats, set {}",
                              values.size(), problem.parameters.size(), repeats, set),
         .fix = "a value each, 2 repeats or more, sets from 0"});
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
                    const std::vector<Run>& runs, const JointFit* fit, const Freedom* made_by) {
  require_sound(problem);
  Verification verification{.values = values, .observables = {}};
  const std::size_t count = problem.observables.size();
  const double level = kLevel / static_cast<double>(count);
  std::vector<CheckSample> samples;
  std::vector<UncertainMean> simulated;
  std::vector<double> measured_uncertainty;
  for (std::size_t i = 0; i < count; ++i) {
    const Observable& observable = problem.observables[i];
    const bool is_stochastic = experiment_named(problem, observable.experiment).is_stochastic;
    samples.push_back(check_sample(problem, values, observable, runs));
    simulated.push_back(mean_of(samples.back(), is_stochastic, fit, i));
    measured_uncertainty.push_back(
        fit != nullptr ? fit->observables[i].measured_uncertainty
                       : with_systematic(observable, standard_uncertainty(observable)));
  }
  const Differences differences(problem, simulated, measured_uncertainty, fit, made_by);
  std::vector<std::size_t> there;
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<Interval> possible;
    if (fit != nullptr) possible = fit->observables[i].reachable;
    verification.observables.push_back(compared(problem.observables[i], samples[i], differences, i,
                                                level, simulated[i], measured_uncertainty[i],
                                                possible));
    if (std::isfinite(verification.observables[i].chance)) there.push_back(i);
  }
  verification.chance = differences.chance(there);
  find_disagreement(verification, level);
  verification.verdict = verdict_of(verification);
  return verification;
}

namespace {

constexpr double kMattersInUncertainty = .5;  // fraction of the measurement uncertainty

SurrogateCheck check_of(const Problem& problem, const JointFit& fit, std::size_t i,
                        const CheckSample& sample) {
  const FittedObservable& fitted = fit.observables[i];
  const bool is_stochastic =
      experiment_named(problem, problem.observables[i].experiment).is_stochastic;
  SurrogateCheck check{.observable = fitted.name,
                       .predicted = fitted.simulated,
                       .uncertainty = fitted.simulated_uncertainty,
                       .simulated = sample.count() > 0 ? sample.mean() : kNone,
                       .chance = kNone};
  if (sample.count() < (is_stochastic ? 2 : 1)) return check;
  const RunScatter scatter = is_stochastic ? scatter_of(sample, &fit, i) : RunScatter{};
  const UncertainMean simulated{sample.mean(), scatter.sd / std::sqrt(sample.count()),
                                static_cast<double>(scatter.df)};
  const double surrogate_df = std::max(fit.surrogates[i].runs - 1, 1);
  const UncertainMean difference =
      difference_of(simulated, {check.predicted, check.uncertainty, surrogate_df});
  check.chance = chance_of(difference);
  check.misses = check.chance < kLevel / static_cast<double>(fit.observables.size()) &&
                 std::abs(difference.value) > kMattersInUncertainty * fitted.measured_uncertainty;
  return check;
}

}  // namespace

std::vector<SurrogateCheck> check_surrogates(const Problem& problem, const JointFit& fit,
                                             const std::vector<Run>& runs) {
  std::vector<double> values;
  for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  std::vector<SurrogateCheck> checks;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    checks.push_back(
        check_of(problem, fit, i, check_sample(problem, values, problem.observables[i], runs)));
  }
  return checks;
}

}  // namespace repose::calibrate
