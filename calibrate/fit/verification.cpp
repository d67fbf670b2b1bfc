#include "calibrate/fit/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/core.h>

#include "base/distributions.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

// Seeds of checks begin here; a study never has so many jobs.
constexpr std::uint64_t kFirstSeed = 1'000'000'000;
constexpr std::uint64_t kSeedsPerSet = 1'000'000;

struct Sample {
  std::vector<double> readings;
  int failed = 0;

  double mean() const {
    double sum = 0;
    for (const double reading : readings) sum += reading;
    return sum / static_cast<double>(readings.size());
  }
  double count() const { return static_cast<double>(readings.size()); }
  /// Of single readings; NaN from one.
  double sd() const {
    const double middle = mean();
    double squares = 0;
    for (const double reading : readings) squares += (reading - middle) * (reading - middle);
    return std::sqrt(squares / (count() - 1));
  }
};

Sample sample_of(const Job& at, const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs) {
  Sample sample;
  for (const Run& run : runs) {
    if (run.job.experiment != at.experiment || run.job.values != at.values) continue;
    if (experiment.is_stochastic && run.job.seed < kFirstSeed) continue;
    const auto found = run.readings.find(reading);
    if (run.failure.empty() && found != run.readings.end() && std::isfinite(found->second)) {
      sample.readings.push_back(found->second);
    } else {
      ++sample.failed;
    }
  }
  return sample;
}

/// Welch and Satterthwaite's degrees of freedom of the difference of two means (Welch 1947,
/// Biometrika 34, 28); infinite ones are left out.
double degrees_of_freedom(const Observable& observable, const Agreement& agreement,
                          double of_simulated) {
  const double measured = agreement.measured_uncertainty;
  const double simulated = agreement.simulated_uncertainty;
  const double sum = measured * measured + simulated * simulated;
  double spread = 0;
  if (observable.sd) spread += std::pow(measured, 4) / (observable.n - 1);
  if (simulated > 0) spread += std::pow(simulated, 4) / of_simulated;
  return spread > 0 ? std::min(sum * sum / spread, 1e6) : 1e6;
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
  std::vector<Job> jobs;
  for (const Experiment& experiment : measured_experiments(problem)) {
    for (int k = 0; k < (experiment.is_stochastic ? repeats : 1); ++k) {
      const std::uint64_t seed = problem.settings.seed + kFirstSeed +
                                 kSeedsPerSet * static_cast<std::uint64_t>(set) +
                                 static_cast<std::uint64_t>(k);
      jobs.push_back(job_at(problem, experiment, to_unit(problem, values), seed));
    }
  }
  return jobs;
}

namespace {

/// Mean and uncertainty of the repeats. Returns the degrees of freedom of the uncertainty.
double add_repeats(const Sample& sample, bool has_chance, const FittedObservable* fitted, int runs,
                   Agreement& agreement) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  agreement.runs = static_cast<int>(sample.readings.size());
  agreement.failed_runs = sample.failed;
  agreement.simulated = sample.readings.empty() ? kNone : sample.mean();
  agreement.simulated_uncertainty = has_chance ? kNone : 0;
  if (!has_chance || agreement.runs < 2) return 1;
  const double sd = sample.sd();
  const bool is_known_better = fitted != nullptr && fitted->simulated_sd > sd;
  agreement.simulated_uncertainty =
      (is_known_better ? fitted->simulated_sd : sd) / std::sqrt(sample.count());
  return is_known_better ? std::max(runs - 1, 1) : agreement.runs - 1;
}

}  // namespace

Verification verify(const Problem& problem, const std::vector<double>& values,
                    const std::vector<Run>& runs, const JointFit* fit) {
  require_sound(problem);
  Verification verification{values, {}, true};
  const double level = 1 - .025 / static_cast<double>(problem.observables.size());
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const Observable& observable = problem.observables[i];
    const FittedObservable* fitted = fit != nullptr ? &fit->observables[i] : nullptr;
    const Experiment& experiment = experiment_named(problem, observable.experiment);
    const Job at = job_at(problem, experiment, to_unit(problem, values), 0);
    const Sample sample = sample_of(at, experiment, observable.reading, runs);
    Agreement agreement;
    agreement.observable = observable.name;
    agreement.measured = observable.mean;
    agreement.measured_uncertainty =
        fitted != nullptr ? fitted->measured_uncertainty : standard_uncertainty(observable);
    const double of_simulated =
        add_repeats(sample, experiment.is_stochastic, fitted,
                    fit != nullptr ? fit->surrogates[i].runs : 0, agreement);
    agreement.difference_sigma =
        (agreement.simulated - agreement.measured) /
        std::hypot(agreement.measured_uncertainty, agreement.simulated_uncertainty);
    bool within = false;
    if (std::isfinite(agreement.difference_sigma)) {
      const double df = degrees_of_freedom(observable, agreement, of_simulated);
      within = std::abs(agreement.difference_sigma) <= base::student_t_quantile(level, df);
    }
    verification.agrees = verification.agrees && within;
    verification.observables.push_back(agreement);
  }
  return verification;
}

}  // namespace repose::calibrate
