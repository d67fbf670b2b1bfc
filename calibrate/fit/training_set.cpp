#include "calibrate/fit/training_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include <fmt/core.h>

#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

auto order_of(const Run& run) {
  return std::tie(run.job.experiment, run.job.values, run.job.seed, run.job.inputs,
                  run.failure, run.readings);
}

void require_of(const Problem& problem, const Run& run) {
  const Job& job = run.job;
  const bool known = std::any_of(problem.experiments.begin(), problem.experiments.end(),
                                 [&](const Experiment& e) { return e.name == job.experiment; });
  if (!known) {
    throw std::invalid_argument(fmt::format(
        "a run of \"{}\": no experiment is called so. Fix: leave the run out", job.experiment));
  }
  const bool numbers = std::all_of(job.values.begin(), job.values.end(),
                                   [](double value) { return std::isfinite(value); });
  if (job.values.size() != problem.parameters.size() || !numbers) {
    throw std::invalid_argument(fmt::format(
        "a run of {} with seed {}: has {} values, {}, for {} parameters. Fix: leave the run out",
        job.experiment, job.seed, job.values.size(), numbers ? "all numbers" : "some not numbers",
        problem.parameters.size()));
  }
  for (const auto& [name, reading] : run.readings) {
    if (!(std::abs(reading) > kMostReading)) continue;
    throw std::invalid_argument(fmt::format(
        "a run of {} with seed {}: its reading \"{}\" is {:g}. Rule: at most {:g}. Fix: leave the "
        "run out",
        job.experiment, job.seed, name, reading, kMostReading));
  }
}

}  // namespace

std::vector<Run> in_order(const Problem& problem, const std::vector<Run>& runs) {
  std::vector<Run> sorted = runs;
  for (const Run& run : sorted) require_of(problem, run);
  std::sort(sorted.begin(), sorted.end(),
            [](const Run& a, const Run& b) { return order_of(a) < order_of(b); });
  const auto same = [](const Run& a, const Run& b) { return a.job == b.job; };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
  return sorted;
}

double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs) {
  if (experiment.scatter_within.empty() || reading != "value") return 0;
  double squares = 0;
  int count = 0;
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name || !run.failure.empty()) continue;
    const auto found = run.readings.find(experiment.scatter_within);
    if (found == run.readings.end() || !std::isfinite(found->second)) continue;
    squares += found->second * found->second;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs) {
  TrainingSet training_set{.parameters = experiment.parameters,
                           .is_stochastic = experiment.is_stochastic,
                           .places = {},
                           .readings = {},
                           .readings_per_run = experiment.readings_per_run,
                           .sd_within = sd_within(experiment, reading, runs)};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    if (run.job.experiment != experiment.name || !run.failure.empty()) continue;
    const auto found = run.readings.find(reading);
    if (found == run.readings.end() || !std::isfinite(found->second)) continue;
    training_set.places.push_back(seen_by(experiment, to_unit(problem, run.job.values)));
    training_set.readings.push_back(found->second);
    training_set.runs.push_back(k);
  }
  return training_set;
}

int Attempts::failures() const {
  return static_cast<int>(std::count(failed.begin(), failed.end(), true));
}

Attempts attempts_of(const Problem& problem, const Experiment& experiment,
                     const std::vector<Run>& runs) {
  Attempts attempts{experiment.parameters, {}, {}};
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name) continue;
    attempts.places.push_back(seen_by(experiment, to_unit(problem, run.job.values)));
    attempts.failed.push_back(!run.failure.empty());
  }
  return attempts;
}

}  // namespace repose::calibrate
