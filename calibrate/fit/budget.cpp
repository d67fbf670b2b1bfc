#include "calibrate/fit/budget.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calibrate/fit/points.h"

namespace repose::calibrate {
namespace {

constexpr int kMaxPerDimension = 12;  // in the first round

int least_jobs(const Experiment& experiment) {
  return 2 * static_cast<int>(experiment.parameters.size()) + 2;
}

/// How many runs of each experiment the seconds buy, in proportion to weight / sqrt(cost).
std::vector<double> bought(const std::vector<Experiment>& experiments,
                           const std::vector<double>& weights, double seconds) {
  double sum = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    sum += weights[i] * std::sqrt(usual_run_s(experiments[i]));
  }
  std::vector<double> counts;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    counts.push_back(sum > 0 ? seconds * weights[i] / std::sqrt(usual_run_s(experiments[i])) / sum
                             : 0);
  }
  return counts;
}

}  // namespace

Cost minimum_cost(const Experiment& experiment) {
  return {.seconds = least_jobs(experiment) * usual_run_s(experiment),
          .jobs = least_jobs(experiment)};
}

Cost minimum_cost(const Problem& problem) {
  Cost cost;
  for (const Experiment& experiment : measured_experiments(problem)) {
    const Cost of_one = minimum_cost(experiment);
    cost.jobs += of_one.jobs;
    cost.seconds += of_one.seconds;
  }
  return cost;
}

double least_budget_s(const Problem& problem) {
  constexpr double kFirstRounds = 1.6;
  return kFirstRounds * minimum_cost(problem).seconds;
}

std::vector<int> first_round_jobs(const Problem& problem) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const Cost least = minimum_cost(problem);
  std::vector<double> weights;
  for (const Experiment& experiment : experiments) {
    weights.push_back(static_cast<double>(experiment.parameters.size()));
  }
  const std::vector<double> counts =
      bought(experiments, weights, kFirstFraction * problem.settings.budget_s);
  // What is wanted beyond the minimum, cut down to what both limits leave.
  std::vector<double> extra;
  double extra_jobs = 0;
  double extra_s = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const int dimensions = static_cast<int>(experiments[i].parameters.size());
    const double most = std::max(kMaxPerDimension * dimensions, least_jobs(experiments[i]));
    extra.push_back(std::max(0., std::min(counts[i], most) - least_jobs(experiments[i])));
    extra_jobs += extra.back();
    extra_s += extra.back() * usual_run_s(experiments[i]);
  }
  double fraction = 1;
  if (extra_jobs > 0)
    fraction = std::min(fraction, (problem.settings.max_jobs - least.jobs) / extra_jobs);
  if (extra_s > 0)
    fraction = std::min(fraction, (problem.settings.budget_s - least.seconds) / extra_s);
  std::vector<int> jobs;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    jobs.push_back(least_jobs(experiments[i]) + static_cast<int>(fraction * extra[i]));
  }
  return jobs;
}

std::vector<int> round_jobs(const Problem& problem, const std::vector<double>& need,
                            const Cost& left, int rounds_left) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  std::vector<int> jobs(experiments.size(), 0);
  if (rounds_left < 1) return jobs;
  const std::vector<double> counts = bought(experiments, need, left.seconds / rounds_left);
  double seconds = left.seconds;
  int count = left.jobs / rounds_left;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (need[i] <= 0) continue;
    const int most = kMaxPerDimension * static_cast<int>(experiments[i].parameters.size());
    const int affordable = static_cast<int>(std::min(seconds / usual_run_s(experiments[i]), 1e6));
    // If wanted at all, at least one run.
    const int wanted = static_cast<int>(std::clamp(std::round(counts[i]), 1., 1e6));
    jobs[i] = std::max(0, std::min({wanted, most, affordable, count}));
    seconds -= jobs[i] * usual_run_s(experiments[i]);
    count -= jobs[i];
  }
  return jobs;
}

}  // namespace repose::calibrate
