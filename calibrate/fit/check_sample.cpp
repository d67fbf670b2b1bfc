#include "calibrate/fit/check_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/fit/points.h"

namespace repose::calibrate {

double CheckSample::mean() const {
  double sum = 0;
  for (const double reading : readings) sum += reading;
  return sum / count();
}

double CheckSample::sd() const {
  const double middle = mean();
  double squares = 0;
  for (const double reading : readings) squares += (reading - middle) * (reading - middle);
  return std::sqrt(squares / (count() - 1));
}

CheckSample check_sample(const Problem& problem, const std::vector<double>& values,
                         const Observable& observable, const std::vector<Run>& runs,
                         const std::optional<AssumedInputs>& inputs) {
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  const AssumedInputs wanted = inputs.value_or(experiment.full);
  const Job at = job_at(problem, experiment, to_unit(problem, values), 0);
  CheckSample sample{.readings = {}, .is_coarse = wanted.size != experiment.full.size};
  for (const Run& run : runs) {
    if (run.job.experiment != at.experiment || run.job.values != at.values) continue;
    if (run.job.inputs != wanted) continue;
    if (experiment.is_stochastic && run.job.seed < kFirstCheckSeed) continue;
    const auto found = run.readings.find(observable.reading);
    if (run.failure.empty() && found != run.readings.end() && std::isfinite(found->second)) {
      sample.readings.push_back(found->second);
    } else {
      ++sample.failed;
    }
  }
  return sample;
}

RunScatter scatter_of(const CheckSample& sample, const JointFit* fit, std::size_t observable) {
  const RunScatter seen{sample.sd(), sample.count() - 1};
  if (fit == nullptr || sample.count() < 2) return seen;
  const SurrogateQuality& quality = fit->surrogates[observable];
  RunScatter known{fit->observables[observable].simulated_sd, quality.scatter_df()};
  if (sample.is_coarse) {
    if (!quality.coarse) return seen;
    known = {known.sd * quality.coarse->scatter, std::max(quality.coarse->runs - 1, 1)};
  }
  return known.sd > seen.sd ? known : seen;
}

UncertainMean mean_of(const CheckSample& sample, bool is_stochastic, const JointFit* fit,
                      std::size_t observable) {
  if (sample.count() == 0)
    return {std::numeric_limits<double>::quiet_NaN(),
            is_stochastic ? std::numeric_limits<double>::quiet_NaN() : 0, 1};
  if (!is_stochastic) return {sample.mean(), 0, 1};
  if (sample.count() < 2) return {sample.mean(), std::numeric_limits<double>::quiet_NaN(), 1};
  const RunScatter scatter = scatter_of(sample, fit, observable);
  return {sample.mean(), scatter.sd / std::sqrt(sample.count()), static_cast<double>(scatter.df)};
}

}  // namespace repose::calibrate
