#include "calibrate/run/minutes_budget.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/points.h"
#include "calibrate/study/study_budget.h"

namespace repose::calibrate {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMinute_s = 60;
/// Fraction of the time for the fits between the rounds; a study of a few coefficients takes some
/// seconds for them, however cheap its runs.
constexpr double kComputed = .1;
constexpr double kLeastComputed_s = 10;
constexpr double kMostOfChecks = .5;

struct Checks {
  int rounds;
  int round_repeats;
  int verification_repeats;
  int family_sets;
};

/// From those of the named budgets down to the fewest that show the scatter of a mean.
constexpr std::array<Checks, 5> kChecks{
    {{3, 6, 24, 2}, {3, 5, 16, 1}, {3, 4, 10, 1}, {2, 3, 6, 0}, {2, 2, 4, 0}}};

Budget budget_with(double minutes, int cores, const Checks& checks) {
  Budget budget = budget_of(minutes, cores);
  budget.check_rounds = checks.rounds;
  budget.round_repeats = checks.round_repeats;
  budget.verification_repeats = checks.verification_repeats;
  budget.family_sets = checks.family_sets;
  return budget;
}

/// On one core here.
struct Work {
  double all_s = 0;
  double checks_s = 0;
  double growing_s = 0;  ///< full runs of larger grains: as long as the time given allows
};

Work work_of(Problem problem, const Budget& budget, const Pace& pace) {
  problem.settings.budget_s = budget.settings.budget_s;
  problem.settings.max_jobs = budget.settings.max_jobs;
  problem.settings.max_rounds = budget.settings.max_rounds;
  Work work;
  for (const ExperimentEstimate& estimate : estimate_of(problem, budget)) {
    const bool is_larger = experiment_named(problem, estimate.experiment).full.size != 1;
    for (const auto& [phase, of_phase] : estimate.phases) {
      const double seconds = pace.at(estimate.experiment) * of_phase.seconds;
      work.all_s += seconds;
      const bool is_check = phase == Phase::checks || phase == Phase::equal_sets;
      if (is_check) work.checks_s += seconds;
      if (is_larger && (is_check || phase == Phase::held_out)) work.growing_s += seconds;
    }
  }
  return work;
}

/// Grows it to the largest that takes no longer, from one that does not.
void grow(const Problem& problem, const Pace& pace, double core_s, Budget& budget) {
  constexpr double kMost = 1e4;  // times the minimum: more runs than a fit makes
  constexpr int kHalvings = 40;
  double low = std::log(budget.settings.budget_s);
  double high = low + std::log(kMost);
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    budget.settings.budget_s = std::exp(middle);
    (work_of(problem, budget, pace).all_s <= core_s ? low : high) = middle;
  }
  budget.settings.budget_s = std::max(std::exp(low), least_budget_s(problem));
}

/// Of the experiments that may have larger grains; 1 if there are none.
double slowest_of(const Pace& pace, const Problem& problem) {
  double slowest = 0;
  for (const Experiment& experiment : problem.experiments) {
    const auto found = pace.find(experiment.name);
    const bool may_have = experiment.coarse || experiment.full.size != 1;
    if (may_have && found != pace.end()) slowest = std::max(slowest, found->second);
  }
  return slowest > 0 ? slowest : 1;
}

double computed_s(double seconds) { return std::max(kComputed * seconds, kLeastComputed_s); }

/// Enough that computed_s() leaves these seconds, plus a margin, rounded up to two digits.
double minutes_for(double seconds) {
  const double minutes =
      std::max(seconds / (1 - kComputed), seconds + kLeastComputed_s) / kMinute_s;
  const double digit = std::pow(10, std::floor(std::log10(minutes)) - 1);
  return std::ceil(1.05 * minutes / digit) * digit;
}

/// Seconds that do allow it: more minutes are more for the checks of larger grains, too.
double enough_s(const Work& least, double core_s) {
  constexpr double kMostGrowing = .5;  // as budget_of() allows
  const double growing = core_s > 0 ? std::min(least.growing_s / core_s, kMostGrowing)
                                    : (least.growing_s > 0 ? kMostGrowing : 0);
  return (least.all_s - least.growing_s) / (1 - growing);
}

[[noreturn]] void refuse_minutes(double minutes, const Problem& problem, const Pace& pace,
                                 int cores, double least_s) {
  std::string dearest;
  double most_s = 0;
  for (const auto& [name, of_one] : pace) {
    const auto found = std::ranges::find(problem.experiments, name, &Experiment::name);
    if (found == problem.experiments.end() || of_one * found->run_s <= most_s) continue;
    dearest = name;
    most_s = of_one * found->run_s;
  }
  throw base::InputError(
      {.subject = "minutes",
       .value = fmt::format("= {:g}", minutes),
       .rule =
           fmt::format("the least fit, its checks included, takes {:.2g} minutes on {} core{} "
                       "of this machine; a run of {} takes {:.2g} s",
                       minutes_for(least_s / cores), cores, cores == 1 ? "" : "s", dearest, most_s),
       .fix = fmt::format("--minutes {:g}, more cores (--jobs), or a study whose {} is faster: "
                          "fewer or softer grains, or without it",
                          minutes_for(least_s / cores), dearest)});
}

}  // namespace

Budget budget_within(double minutes, const Problem& problem, const Pace& pace, int cores,
                     double spent_s) {
  const double seconds = kMinute_s * minutes - spent_s;
  const double core_s = (seconds - computed_s(kMinute_s * minutes)) * cores;
  Budget budget;
  for (const Checks& checks : kChecks) {
    budget = budget_with(minutes, cores, checks);
    budget.settings.budget_s = least_budget_s(problem);
    const bool is_last = &checks == &kChecks.back();
    const Work least = work_of(problem, budget, pace);
    if (least.all_s > core_s) {
      if (!is_last) continue;
      refuse_minutes(minutes, problem, pace, cores, enough_s(least, core_s) + spent_s * cores);
    }
    grow(problem, pace, core_s, budget);
    const Work work = work_of(problem, budget, pace);
    if (is_last || work.checks_s <= kMostOfChecks * work.all_s) break;
  }
  budget.settings.budget_s = std::floor(budget.settings.budget_s * 100) / 100;
  budget.settings.budget_s = std::max(budget.settings.budget_s, least_budget_s(problem));
  budget.description = fmt::format(
      "{:g} minutes on {} core{} for all of it, as foreseen before it began: {:.4g} s by the "
      "program's own measure for the fit, and {} fresh runs of the dearest experiment in the last "
      "check",
      minutes, cores, cores == 1 ? "" : "s", budget.settings.budget_s, budget.verification_repeats);
  return budget;
}

Budget budget_of_minutes(double minutes, const PreparedStudy& study,
                         const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t, std::size_t)>& timed) {
  constexpr double kMostTimed_s = 20, kOfTheTime = .03;
  const Clock::time_point start = Clock::now();
  if (const auto notes = read_study_notes(study.folder); notes && notes->limits) {
    StudyIdentity own = identity_of(study.record);
    own.budget = name_of_minutes(minutes);
    if (is_same_study(notes->study, own)) return *notes->limits;
  }
  const Pace pace = timed_pace(study, std::min(kMostTimed_s, kOfTheTime * kMinute_s * minutes),
                               is_interrupted, timed);
  // The longest run is one of this machine.
  Budget allowed = budget_of(minutes, study.threads, slowest_of(pace, study.problem.problem));
  allowed.is_full = study.record.budget.is_full;
  const Problem problem = problem_of(study.record.study, study.record.grain, allowed).problem;
  const std::chrono::duration<double> spent = Clock::now() - start;
  Budget budget = budget_within(minutes, problem, pace, study.threads, spent.count());
  budget.longest_run_s = allowed.longest_run_s;
  return budget;
}

}  // namespace repose::calibrate
