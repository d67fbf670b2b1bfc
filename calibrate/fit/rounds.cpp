#include "calibrate/fit/rounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "calibrate/fit/best_places.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/first_round.h"
#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/sequence.h"
#include "calibrate/fit/training_set.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kCandidates = 150;
constexpr int kSpreadEvery = 8;         // one of so many jobs looks elsewhere
constexpr double kKnownWell = .06;      // surrogate variance over measured: adds 3 % to sigma
constexpr double kSettledMove = .5;     // of the scatter of the plausible sets
constexpr double kSettledScatter = .2;  // relative change

struct JobLess {
  bool operator()(const Job& a, const Job& b) const {
    return std::tie(a.experiment, a.values, a.seed, a.inputs) <
           std::tie(b.experiment, b.values, b.seed, b.inputs);
  }
};

/// What the rounds so far say.
class Study {
 public:
  explicit Study(const Problem& problem)
      : problem_(problem), experiments_(measured_experiments(problem)) {}

  /// Takes the runs of one more complete round.
  void learn(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
      known_.push_back(run);
      spent_.jobs += 1;
      spent_.seconds += experiment_named(problem_, run.job.experiment).run_s;
      planned_.insert(run.job);
    }
    known_ = in_order(problem_, known_);
    misfit_ = Misfit(problem_, known_, misfit_, false);
    const Minimum minimum = least_minimum(*misfit_, {});
    misfit_->inflate_near(minimum.point);
    sets_ = plausible_sets(*misfit_, problem_.settings.seed);
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
    for (std::size_t e = 0; e < experiments_.size(); ++e) add_jobs(e, counts[e], jobs);
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

  /// The candidates' mean of the surrogate's variance in measured ones.
  double surrogate_variance_fraction(std::size_t observable) const {
    double sum = 0;
    for (const Point& point : sets_.points)
      sum += misfit_->surrogate_variance_fraction(observable, point);
    return sum / static_cast<double>(sets_.points.size());
  }

  /// Of each experiment: how much its surrogates add to the uncertainty; 0 where that is little.
  std::vector<double> needs() const {
    std::vector<double> needs;
    for (const Experiment& experiment : experiments_) {
      double most = 0;
      for (const std::size_t i : observables_of(experiment))
        most = std::max(most, surrogate_variance_fraction(i));
      // A surrogate that knows nothing yet must not take everything from the others.
      needs.push_back(most > kKnownWell ? std::min(std::sqrt(most), 5.) : 0);
    }
    return needs;
  }

  std::vector<Point> candidates() const {
    std::vector<Point> chosen;
    for (std::size_t i = 0; i < kCandidates; ++i) {
      chosen.push_back(sets_.wide[i * sets_.wide.size() / kCandidates]);
    }
    return chosen;
  }

  void add_jobs(std::size_t e, int count, std::vector<Job>& jobs) const {
    if (count < 1) return;
    const Experiment& experiment = experiments_[e];
    const auto elsewhere = static_cast<std::size_t>(count / kSpreadEvery);
    const std::vector<Point> sets = candidates();
    std::vector<Surrogate> surrogates;
    std::vector<double> weights;
    for (const std::size_t i : observables_of(experiment)) {
      surrogates.push_back(misfit_->surrogates()[i]);
      weights.push_back(misfit_->weight(i));
    }
    std::vector<Point> places;
    for (const std::size_t i :
         best_places(surrogates, weights, sets, static_cast<std::size_t>(count) - elsewhere)) {
      places.push_back(sets[i]);
    }
    const auto before = static_cast<std::size_t>(
        std::count_if(planned_.begin(), planned_.end(),
                      [&](const Job& job) { return job.experiment == experiment.name; }));
    for (std::size_t i = 0; i < elsewhere; ++i) {
      places.push_back(sequence_point(before + i, problem_.parameters.size()));
    }
    std::uint64_t seed = problem_.settings.seed + before;
    for (const Point& place : places) {
      const Job job = job_at(problem_, experiment, place, seed++);
      // Without chance the same place again has nothing new.
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
  PlausibleSets sets_;
  std::vector<RoundSummary> summaries_;
};

/// The runs there are, by their jobs.
class Done {
 public:
  Done(const Problem& problem, const std::vector<Run>& runs) {
    for (const Run& run : in_order(problem, runs)) runs_.emplace(run.job, run);
  }

  /// The runs of these jobs; none, and the jobs that are missing, where some are.
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

Rounds replay(const Problem& problem, const std::vector<Run>& runs) {
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
