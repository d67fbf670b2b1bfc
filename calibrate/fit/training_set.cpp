#include "calibrate/fit/training_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "base/input_error.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

auto order_of(const Run& run) {
  return std::tie(run.job.experiment, run.job.values, run.job.seed, run.job.inputs, run.failure,
                  run.readings);
}

void require_of(const Problem& problem, const Run& run) {
  const Job& job = run.job;
  const bool known = std::any_of(problem.experiments.begin(), problem.experiments.end(),
                                 [&](const Experiment& e) { return e.name == job.experiment; });
  if (!known) {
    throw base::InputError(
        {.value = fmt::format("a run of \"{}\": no experiment is called so", job.experiment),
         .fix = "leave the run out"});
  }
  const bool numbers = std::all_of(job.values.begin(), job.values.end(),
                                   [](double value) { return std::isfinite(value); });
  if (job.values.size() != problem.parameters.size() || !numbers) {
    throw base::InputError(
        {.value =
             fmt::format("a run of {} with seed {}: has {} values, {}, for {} parameters",
                         job.experiment, job.seed, job.values.size(),
                         numbers ? "all numbers" : "some not numbers", problem.parameters.size()),
         .fix = "leave the run out"});
  }
  for (const auto& [name, reading] : run.readings) {
    if (!(std::abs(reading) > kMostReading)) continue;
    throw base::InputError(
        {.value = fmt::format("a run of {} with seed {}: its reading \"{}\" is {:g}",
                              job.experiment, job.seed, name, reading),
         .rule = fmt::format("at most {:g}", kMostReading),
         .fix = "leave the run out"});
  }
}

/// What two runs differ by beyond this is not the simulation's rounding.
constexpr double kAlike = 1e-9;  // of the reading, or of its unit where that is more

bool is_alike(double one, double other) {
  return std::abs(one - other) <= kAlike * std::max({1., std::abs(one), std::abs(other)});
}

/// None where there is no such number.
std::optional<double> reading_of(const Run& run, const std::string& name) {
  const auto found = run.readings.find(name);
  if (!run.failure.empty() || found == run.readings.end() || !std::isfinite(found->second)) {
    return std::nullopt;
  }
  return found->second;
}

/// In everything that a bench could measure.
bool is_alike(const Experiment& experiment, const Run& one, const Run& other) {
  return std::ranges::all_of(experiment.measurable, [&](const std::string& name) {
    const std::optional<double> a = reading_of(one, name), b = reading_of(other, name);
    return a && b ? is_alike(*a, *b) : a.has_value() == b.has_value();
  });
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

bool has_chance(const Experiment& experiment, const std::vector<Run>& runs) {
  // A reading that all runs share, as of grains that never leave, would say nothing of chance.
  constexpr std::size_t kFewest = 2;
  if (!experiment.is_stochastic) return false;
  std::set<double> repeated;
  const Run* first = nullptr;
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name) continue;
    if (first == nullptr || first->job.values != run.job.values) {
      first = &run;
      continue;
    }
    if (!is_alike(experiment, *first, run)) return true;
    if (const auto value = reading_of(*first, "value")) repeated.insert(*value);
  }
  return repeated.size() < kFewest;
}

double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs) {
  if (experiment.scatter_within.empty() || reading != "value") return 0;
  double squares = 0;
  int count = 0;
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name) continue;
    const std::optional<double> sd = reading_of(run, experiment.scatter_within);
    if (!sd) continue;
    squares += *sd * *sd;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs) {
  TrainingSet training_set{.parameters = experiment.parameters,
                           .is_stochastic = has_chance(experiment, runs),
                           .places = {},
                           .readings = {},
                           .readings_per_run = experiment.readings_per_run,
                           .sd_within = sd_within(experiment, reading, runs)};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    if (run.job.experiment != experiment.name) continue;
    const std::optional<double> value = reading_of(run, reading);
    if (!value) continue;
    Point place = seen_by(experiment, to_unit(problem, run.job.values));
    const bool is_repeat = !training_set.places.empty() && training_set.places.back() == place;
    if (is_repeat && !training_set.is_stochastic) continue;
    training_set.places.push_back(std::move(place));
    training_set.readings.push_back(*value);
    training_set.runs.push_back(k);
  }
  return training_set;
}

int readings_among(const Experiment& experiment, const std::string& reading,
                   const std::vector<Run>& runs) {
  return static_cast<int>(std::ranges::count_if(runs, [&](const Run& run) {
    return run.job.experiment == experiment.name && reading_of(run, reading);
  }));
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
