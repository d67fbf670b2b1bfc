#include "calibrate/fit/rounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <Eigen/Core>

#include "calibrate/fit/best_places.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

namespace {

constexpr int kRepeatEvery = 5;
constexpr double kDear = 10;               // times the cost of a run of the cheap experiment
constexpr std::size_t kAnywhereEvery = 8;  // one place in this many is anywhere in the box

/// Maps a place of the sequence to its final position.
using Placing = std::function<Point(std::size_t place, Point point)>;

/// `count` of the usual runs.
void add_jobs(const Problem& problem, const Experiment& experiment, int count,
              const Placing& placing, std::vector<Job>& jobs) {
  std::size_t place = 0;
  for (int k = 0; k < count; ++k) {
    // The job after every fifth place repeats that place.
    const bool repeat = experiment.is_stochastic && k % (kRepeatEvery + 1) == kRepeatEvery;
    if (k > 0 && !repeat) ++place;
    const Point own = sequence_point(place, experiment.parameters.size());
    Point point(problem.parameters.size(), .5);
    for (std::size_t c = 0; c < own.size(); ++c) point[experiment.parameters[c]] = own[c];
    Job job = job_at(problem, experiment, placing(place, std::move(point)),
                     problem.settings.seed + static_cast<unsigned>(k));
    job.inputs = experiment.usual_inputs();
    jobs.push_back(std::move(job));
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

/// Values of each parameter that some leading experiment depends on, ascending; empty for others.
using Marginals = std::vector<std::vector<double>>;

Marginals plausible_values(const Problem& leading, const std::vector<Run>& runs) {
  Misfit misfit(leading, in_order(leading, runs), {}, false);
  misfit.inflate_near(least_minimum(misfit, {}).point);
  const PosteriorSamples sets = posterior_samples(misfit, leading.settings.seed);
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

namespace {

constexpr double kSettledMove = .5;     // of the scatter of the plausible sets
constexpr double kSettledScatter = .2;  // relative change

struct JobLess {
  bool operator()(const Job& a, const Job& b) const {
    return std::tie(a.experiment, a.values, a.seed, a.inputs) <
           std::tie(b.experiment, b.values, b.seed, b.inputs);
  }
};

/// State of the study after the rounds so far.
class Study {
 public:
  explicit Study(const Problem& problem)
      : problem_(problem), experiments_(measured_experiments(problem)) {}

  /// Adds the runs of one more complete round.
  void learn(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
      known_.push_back(run);
      spent_.jobs += 1;
      spent_.seconds += run_s_of(experiment_named(problem_, run.job.experiment), run.job.inputs);
      planned_.insert(run.job);
    }
    known_ = in_order(problem_, known_);
    misfit_ = Misfit(problem_, known_, misfit_, false);
    const Minimum minimum = least_minimum(*misfit_, {});
    misfit_->inflate_near(minimum.point);
    sets_ = posterior_samples(*misfit_, problem_.settings.seed);
    summarise();
  }

  const std::vector<RoundSummary>& summaries() const { return summaries_; }

  std::vector<Job> next_round() const {
    const int rounds_left = problem_.settings.max_rounds - static_cast<int>(summaries_.size());
    if (rounds_left < 1 || settled()) return {};
    const Cost left{problem_.settings.budget_s - spent_.seconds,
                    problem_.settings.max_jobs - spent_.jobs};
    const std::vector<int> counts = round_jobs(problem_, needs(), left, rounds_left);
    std::vector<Job> jobs;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
      add_jobs(e, counts[e], left.seconds, jobs);
    }
    return jobs;
  }

 private:
  void summarise() {
    RoundSummary summary;
    summary.round = static_cast<int>(summaries_.size());
    summary.jobs = spent_.jobs;
    summary.seconds = spent_.seconds;
    const Point mean = mean_of(sets_.points);
    const Point sd = sd_of(sets_.points);
    for (std::size_t j = 0; j < mean.size(); ++j) {
      const Parameter& parameter = problem_.parameters[j];
      const double width = parameter.max - parameter.min;
      summary.values.push_back(parameter.min + mean[j] * width);
      summary.sd.push_back(sd[j] * width);
      std::vector<double> places;
      for (const Point& point : sets_.points) places.push_back(point[j]);
      std::ranges::sort(places);
      summary.intervals.push_back({parameter.min + quantile(places, .025) * width,
                                   parameter.min + quantile(places, .975) * width});
    }
    summaries_.push_back(summary);
  }

  /// The plausible sets moved little in the last two rounds.
  bool settled() const {
    if (summaries_.size() < 3) return false;
    for (std::size_t k = summaries_.size() - 2; k < summaries_.size(); ++k) {
      const RoundSummary& before = summaries_[k - 1];
      const RoundSummary& after = summaries_[k];
      for (std::size_t j = 0; j < after.values.size(); ++j) {
        if (std::abs(after.values[j] - before.values[j]) > kSettledMove * after.sd[j]) return false;
        if (std::abs(after.sd[j] - before.sd[j]) > kSettledScatter * after.sd[j]) return false;
      }
    }
    return true;
  }

  std::vector<std::size_t> observables_of(const Experiment& experiment) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < problem_.observables.size(); ++i) {
      if (problem_.observables[i].experiment == experiment.name) found.push_back(i);
    }
    return found;
  }

  /// For each experiment: how much its surrogates add to the uncertainty; 0 if that is little.
  std::vector<double> needs() const {
    std::vector<double> needs;
    for (const Experiment& experiment : experiments_) {
      double most = 0;
      for (const std::size_t i : observables_of(experiment))
        most = std::max(most, unknown_fraction(*misfit_, sets_, i));
      // A surrogate that knows nothing yet must not take everything from the others.
      needs.push_back(most > kKnownWell ? std::min(std::sqrt(most), 5.) : 0);
    }
    return needs;
  }

  /// `count` of its usual runs, or a more informative selection of the same total duration.
  std::vector<ChosenRun> chosen_runs(const Experiment& experiment, std::size_t count, double left_s,
                                     const std::vector<Point>& candidates) const {
    std::vector<Surrogate> surrogates;
    std::vector<double> weights;
    for (const std::size_t i : observables_of(experiment)) {
      surrogates.push_back(misfit_->surrogates()[i]);
      weights.push_back(misfit_->weight(i));
    }
    if (experiment.coarse) {
      const RunCosts costs{.full_s = experiment.run_s, .coarse_s = usual_run_s(experiment)};
      return best_runs(surrogates, weights, candidates, costs,
                       static_cast<double>(count) * costs.coarse_s, left_s);
    }
    std::vector<ChosenRun> runs;
    for (const std::size_t place : best_places(surrogates, weights, candidates, count)) {
      runs.push_back({place, RunKind::full});
    }
    return runs;
  }

  void add_jobs(std::size_t e, int count, double left_s, std::vector<Job>& jobs) const {
    if (count < 1) return;
    const Experiment& experiment = experiments_[e];
    const auto elsewhere = static_cast<std::size_t>(count / kSpreadEvery);
    const std::vector<Point> sets = candidate_places(sets_);
    const auto before = static_cast<std::size_t>(
        std::count_if(planned_.begin(), planned_.end(),
                      [&](const Job& job) { return job.experiment == experiment.name; }));
    std::vector<Job> planned;
    std::uint64_t seed = problem_.settings.seed + before;
    const auto plan = [&](const Point& place, RunKind kind) {
      Job& job = planned.emplace_back(job_at(problem_, experiment, place, seed++));
      if (kind == RunKind::coarse) job.inputs = experiment.usual_inputs();
    };
    for (const ChosenRun& run :
         chosen_runs(experiment, static_cast<std::size_t>(count) - elsewhere, left_s, sets)) {
      plan(sets[run.place], run.kind);
    }
    for (std::size_t i = 0; i < elsewhere; ++i) {
      plan(sequence_point(before + i, problem_.parameters.size()),
           experiment.coarse ? RunKind::coarse : RunKind::full);
    }
    for (const Job& job : planned) {
      // If deterministic, the same place again adds nothing new.
      if (!planned_.contains(job) && std::find(jobs.begin(), jobs.end(), job) == jobs.end()) {
        jobs.push_back(job);
      }
    }
  }

  const Problem& problem_;
  std::vector<Experiment> experiments_;
  std::vector<Run> known_;
  std::set<Job, JobLess> planned_;
  Cost spent_;
  std::optional<Misfit> misfit_;
  PosteriorSamples sets_;
  std::vector<RoundSummary> summaries_;
};

/// The completed runs, by their jobs.
class Done {
 public:
  Done(const Problem& problem, const std::vector<Run>& runs) {
    for (const Run& run : in_order(problem, runs)) runs_.emplace(run.job, run);
  }

  /// The runs of these jobs; std::nullopt, and the missing jobs, if some are missing.
  std::optional<std::vector<Run>> take(const std::vector<Job>& jobs,
                                       std::vector<Job>& missing) const {
    std::vector<Run> taken;
    for (const Job& job : jobs) {
      const auto found = runs_.find(job);
      if (found == runs_.end()) {
        missing.push_back(job);
      } else {
        taken.push_back(found->second);
      }
    }
    if (!missing.empty()) return std::nullopt;
    return taken;
  }

 private:
  std::map<Job, Run, JobLess> runs_;
};

}  // namespace

Rounds reconstruct_rounds(const Problem& problem, const std::vector<Run>& runs) {
  const Done done(problem, runs);
  Rounds rounds;
  Study study(problem);
  const auto lead = done.take(leading_jobs(problem), rounds.missing);
  if (!lead) return rounds;
  std::optional<std::vector<Run>> round = done.take(following_jobs(problem, *lead), rounds.missing);
  if (!round) return rounds;
  round->insert(round->begin(), lead->begin(), lead->end());
  while (round && !round->empty()) {
    study.learn(*round);
    rounds.complete = study.summaries();
    round = done.take(study.next_round(), rounds.missing);
  }
  return rounds;
}

}  // namespace repose::calibrate
