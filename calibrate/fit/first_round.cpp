#include "calibrate/fit/first_round.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "calibrate/fit/budget.h"
#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/sequence.h"
#include "calibrate/fit/training_set.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr int kRepeatEvery = 5;
constexpr double kDear = 10;               // times the cost of a run of the cheap experiment
constexpr std::size_t kAnywhereEvery = 8;  // one of so many places is anywhere in the box

/// Where a place of the sequence comes to lie.
using Placing = std::function<Point(std::size_t place, Point point)>;

void add_jobs(const Problem& problem, const Experiment& experiment, int count,
              const Placing& placing, std::vector<Job>& jobs) {
  std::size_t place = 0;
  for (int k = 0; k < count; ++k) {
    // The job after every fifth place is at that place again.
    const bool repeat = experiment.is_stochastic && k % (kRepeatEvery + 1) == kRepeatEvery;
    if (k > 0 && !repeat) ++place;
    const Point own = sequence_point(place, experiment.parameters.size());
    Point point(problem.parameters.size(), .5);
    for (std::size_t c = 0; c < own.size(); ++c) point[experiment.parameters[c]] = own[c];
    jobs.push_back(job_at(problem, experiment, placing(place, std::move(point)),
                          problem.settings.seed + static_cast<unsigned>(k)));
  }
}

Point as_it_is(std::size_t /*place*/, Point point) { return point; }

/// Parameters are in ascending order.
bool follows(const Experiment& dear, const Experiment& cheap) {
  return dear.run_s >= kDear * cheap.run_s && dear.parameters.size() > cheap.parameters.size() &&
         std::ranges::includes(dear.parameters, cheap.parameters);
}

bool is_follower(const std::vector<Experiment>& all, const Experiment& experiment) {
  return std::ranges::any_of(all,
                             [&](const Experiment& other) { return follows(experiment, other); });
}

/// The problem as if only the leading experiments had been measured.
Problem leading_part(const Problem& problem) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  Problem part = problem;
  std::erase_if(part.observables, [&](const Observable& observable) {
    return is_follower(experiments, experiment_named(problem, observable.experiment));
  });
  return part;
}

/// Values of each parameter that some leading experiment depends on, ascending; else none.
using Marginals = std::vector<std::vector<double>>;

Marginals plausible_values(const Problem& leading, const std::vector<Run>& runs) {
  Misfit misfit(leading, in_order(leading, runs), {}, false);
  misfit.inflate_near(least_minimum(misfit, {}).point);
  const PlausibleSets sets = plausible_sets(misfit, leading.settings.seed);
  Marginals marginals(leading.parameters.size());
  for (const Experiment& experiment : measured_experiments(leading)) {
    for (const std::size_t j : experiment.parameters) {
      marginals[j].clear();
      for (const Point& point : sets.wide) marginals[j].push_back(point[j]);
      std::ranges::sort(marginals[j]);
    }
  }
  return marginals;
}

double quantile(const std::vector<double>& ascending, double fraction) {
  const double at = fraction * static_cast<double>(ascending.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), ascending.size() - 2);
  return std::lerp(ascending[below], ascending[below + 1], at - static_cast<double>(below));
}

enum class Part { leading, following };

std::vector<Job> jobs_of(const Problem& problem, Part part, const Placing& placing) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const std::vector<int> counts = first_round_jobs(problem);
  std::vector<Job> jobs;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const bool follows_another = is_follower(experiments, experiments[e]);
    if (follows_another != (part == Part::following)) continue;
    add_jobs(problem, experiments[e], counts[e], placing, jobs);
  }
  return jobs;
}

}  // namespace

std::vector<Job> first_round(const Problem& problem) {
  std::vector<Job> jobs = leading_jobs(problem);
  std::ranges::move(jobs_of(problem, Part::following, as_it_is), std::back_inserter(jobs));
  return jobs;
}

bool has_followers(const Problem& problem) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  return std::ranges::any_of(experiments, [&](const Experiment& experiment) {
    return is_follower(experiments, experiment);
  });
}

std::vector<Job> leading_jobs(const Problem& problem) {
  return jobs_of(problem, Part::leading, as_it_is);
}

std::vector<Job> following_jobs(const Problem& problem, const std::vector<Run>& leading) {
  if (!has_followers(problem)) return {};
  const Marginals plausible = plausible_values(leading_part(problem), leading);
  return jobs_of(problem, Part::following, [&](std::size_t place, Point point) {
    if (place % kAnywhereEvery == kAnywhereEvery - 1) return point;
    for (std::size_t j = 0; j < point.size(); ++j) {
      if (!plausible[j].empty()) point[j] = quantile(plausible[j], point[j]);
    }
    return point;
  });
}

}  // namespace repose::calibrate
