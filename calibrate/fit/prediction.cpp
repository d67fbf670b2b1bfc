#include "calibrate/fit/prediction.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/distributions.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {
namespace {

/// Checks of parameter sets use seeds up to some millions above kFirstCheckSeed.
constexpr std::uint64_t kFirstPredictionSeed = kFirstCheckSeed + 500'000'000;
constexpr std::size_t kFewestSets = 3;  // two say nothing about their scatter

int repeats_of(const Experiment& experiment) {
  return experiment.is_stochastic ? kPredictionRepeats : 1;
}

Job job_of(const Problem& problem, const Experiment& experiment, const std::vector<double>& values,
           std::size_t number) {
  return job_at(problem, experiment, to_unit(problem, values),
                problem.settings.seed + kFirstPredictionSeed + number);
}

/// Spread over the bounds of the experiment's parameters; `first`: the number of the first job.
std::vector<Job> range_jobs(const Problem& problem, const Experiment& experiment,
                            std::size_t first) {
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < kRangeRuns; ++k) {
    const Point own = sequence_point(k, experiment.parameters.size());
    Point point(problem.parameters.size(), .5);
    for (std::size_t j = 0; j < own.size(); ++j) point[experiment.parameters[j]] = own[j];
    jobs.push_back(job_at(problem, experiment, point,
                          problem.settings.seed + kFirstPredictionSeed + first + k));
  }
  return jobs;
}

std::size_t drawn_jobs(const Experiment& experiment, const JointFit& fit) {
  return fit.drawn.size() * static_cast<std::size_t>(repeats_of(experiment));
}

/// std::nullopt: the run was not made, or gave no reading.
std::optional<double> reading_of_job(const std::vector<Run>& runs, const Job& job,
                                     const std::string& reading) {
  const auto run = std::ranges::find(runs, job, &Run::job);
  if (run == runs.end() || !run->failure.empty()) return std::nullopt;
  const auto found = run->readings.find(reading);
  if (found == run->readings.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second;
}

/// Means at the sets that gave a reading, and the scatter of runs at one set.
struct SetMeans {
  std::vector<double> means;
  double per_set = 0;         ///< mean of 1 / runs
  double within_squares = 0;  ///< of runs against the mean of their set
  int within_df = 0;
  int failed = 0;

  void add(const std::vector<double>& readings);
  double run_variance() const { return within_df > 0 ? within_squares / within_df : 0; }
};

void SetMeans::add(const std::vector<double>& readings) {
  if (readings.empty()) return;
  double mean = 0;
  for (const double reading : readings) mean += reading / static_cast<double>(readings.size());
  for (const double reading : readings) within_squares += (reading - mean) * (reading - mean);
  within_df += static_cast<int>(readings.size()) - 1;
  per_set =
      (per_set * static_cast<double>(means.size()) + 1. / static_cast<double>(readings.size())) /
      static_cast<double>(means.size() + 1);
  means.push_back(mean);
}

SetMeans means_of(const Problem& problem, const JointFit& fit, const Observable& observable,
                  const std::vector<Run>& runs) {
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  SetMeans sets;
  std::size_t number = 0;
  for (const std::vector<double>& values : fit.drawn) {
    std::vector<double> readings;
    for (int k = 0; k < repeats_of(experiment); ++k, ++number) {
      const Job job = job_of(problem, experiment, values, number);
      if (std::ranges::find(runs, job, &Run::job) == runs.end()) continue;
      if (const auto reading = reading_of_job(runs, job, observable.reading)) {
        readings.push_back(*reading);
      } else {
        ++sets.failed;
      }
    }
    sets.add(readings);
  }
  return sets;
}

double average_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double variance_of(const std::vector<double>& values) {
  const double mean = average_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

/// The standard uncertainty of a measured mean; an assumed scatter is no less than that of single
/// readings in the simulation, as in the fit.
double measured_uncertainty_of(const Problem& problem, const Observable& observable, double run_sd,
                               const std::vector<Run>& runs) {
  const double known = standard_uncertainty(observable);
  if (observable.sd) return with_systematic(observable, known);
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  const double reading_sd = std::hypot(run_sd * std::sqrt(experiment.readings_per_run),
                                       sd_within(experiment, observable.reading, runs));
  return with_systematic(observable, std::max(known, reading_sd / std::sqrt(observable.n)));
}

/// From the runs spread over the bounds and at the drawn sets, as far as a bench can read it.
std::optional<Interval> possible_of(const Problem& problem, const JointFit& fit,
                                    const Observable& observable, const std::vector<Run>& runs,
                                    const SetMeans& sets) {
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  std::vector<double> readings = sets.means;
  for (const Job& job : range_jobs(problem, experiment, drawn_jobs(experiment, fit))) {
    if (const auto reading = reading_of_job(runs, job, observable.reading)) {
      readings.push_back(*reading);
    }
  }
  if (readings.empty()) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(readings);
  return Interval{std::clamp(low, observable.least, observable.most),
                  std::clamp(high, observable.least, observable.most)};
}

Prediction prediction_of(const Problem& problem, const JointFit& fit, const Observable& observable,
                         const std::vector<Run>& runs) {
  const SetMeans sets = means_of(problem, fit, observable, runs);
  const double assumed = with_systematic(observable, standard_uncertainty(observable));
  Prediction prediction{.name = observable.name,
                        .unit = observable.unit,
                        .measured = observable.mean,
                        .measured_uncertainty = assumed,
                        .predicted = kNone,
                        .uncertainty = kNone,
                        .interval = {kNone, kNone},
                        .coefficients_sd = kNone,
                        .run_sd = kNone,
                        .model_sd = fit.model_error_scale.value_or(1) * observable.model_sd,
                        .difference_sigma = kNone,
                        .chance = kNone,
                        .tolerance = kNone,
                        .sets = static_cast<int>(sets.means.size()),
                        .failed_runs = sets.failed};
  prediction.possible = possible_of(problem, fit, observable, runs, sets);
  const Margin margin = margin_of(observable, prediction.possible);
  prediction.tolerance = margin.value;
  prediction.tolerance_from = margin.source;
  if (sets.means.size() < kFewestSets) {
    // Since the bench has a reading, coefficients that never give one are wrong.
    if (sets.means.empty()) prediction.verdict = AgreementVerdict::disagrees;
    return prediction;
  }
  const double between = variance_of(sets.means);
  const auto count = static_cast<double>(sets.means.size());
  const double by_coefficients = std::max(0., between - sets.run_variance() * sets.per_set);
  prediction.predicted = average_of(sets.means);
  prediction.coefficients_sd = std::sqrt(by_coefficients);
  prediction.run_sd = std::sqrt(sets.run_variance());
  const UncertainMean of_sets{prediction.predicted, std::sqrt(by_coefficients + between / count),
                              count - 1};
  prediction.measured_uncertainty =
      measured_uncertainty_of(problem, observable, prediction.run_sd, runs);
  judge(problem, observable, of_sets, prediction);
  return prediction;
}

}  // namespace

void judge(const Problem& problem, const Observable& observable, const UncertainMean& of_sets,
           Prediction& prediction) {
  const UncertainMean real = with_known(of_sets, prediction.model_sd);
  prediction.uncertainty = real.uncertainty;
  const double half =
      base::student_t_quantile(.975, std::min(real.df, base::kManyDf)) * real.uncertainty;
  prediction.interval = {std::max(prediction.predicted - half, observable.least),
                         std::min(prediction.predicted + half, observable.most)};
  const double scatter2 = std::max(
      0., std::pow(prediction.measured_uncertainty, 2) - std::pow(observable.systematic_sd, 2));
  const UncertainMean bench =
      with_known({prediction.measured, std::sqrt(scatter2), degrees_of_scatter(observable)},
                 observable.systematic_sd);
  // An error of the model makes a difference no less real, only less of a surprise; that of larger
  // grains does both.
  const UncertainMean difference = with_known(difference_of(of_sets, bench), observable.size_sd);
  const UncertainMean by_chance = difference_of(real, bench);
  prediction.difference_sigma = by_chance.value / by_chance.uncertainty;
  prediction.chance = chance_of(by_chance);
  const Interval within = equivalence_interval(difference);
  if (within.low >= -prediction.tolerance && within.high <= prediction.tolerance) {
    prediction.verdict = AgreementVerdict::agrees;
  } else if (prediction.chance < kLevel / static_cast<double>(problem.held_out.size())) {
    prediction.verdict = AgreementVerdict::disagrees;
  }
  if (prediction.verdict != AgreementVerdict::cannot_tell) return;
  prediction.readings_to_decide =
      readings_to_decide(difference, std::sqrt(scatter2), observable.n, prediction.tolerance,
                         kLevel / static_cast<double>(problem.held_out.size()));
}

std::vector<Job> prediction_jobs(const Problem& problem, const JointFit& fit) {
  std::vector<Job> jobs;
  for (const Experiment& experiment : held_out_experiments(problem)) {
    std::size_t number = 0;
    for (const std::vector<double>& values : fit.drawn) {
      for (int k = 0; k < repeats_of(experiment); ++k, ++number) {
        jobs.push_back(job_of(problem, experiment, values, number));
      }
    }
    const std::vector<Job> range = range_jobs(problem, experiment, number);
    jobs.insert(jobs.end(), range.begin(), range.end());
  }
  return jobs;
}

std::vector<Experiment> held_out_experiments(const Problem& problem) {
  std::vector<Experiment> held_out;
  std::ranges::copy_if(problem.experiments, std::back_inserter(held_out),
                       [&](const Experiment& experiment) {
                         return std::ranges::any_of(problem.held_out, [&](const Observable& one) {
                           return one.experiment == experiment.name;
                         });
                       });
  return held_out;
}

int prediction_runs(const Experiment& experiment) {
  return static_cast<int>(kDrawnSets) * repeats_of(experiment) + static_cast<int>(kRangeRuns);
}

std::vector<Prediction> predictions_of(const Problem& problem, const JointFit& fit,
                                       const std::vector<Run>& runs) {
  std::vector<Prediction> predictions;
  for (const Observable& observable : problem.held_out) {
    predictions.push_back(prediction_of(problem, fit, observable, runs));
  }
  return predictions;
}

}  // namespace repose::calibrate
