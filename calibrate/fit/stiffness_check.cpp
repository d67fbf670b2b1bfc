#include "calibrate/fit/stiffness_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/distributions.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr std::uint64_t kFirstStiffnessSeed = kFirstCheckSeed + 700'000'000;
constexpr double kStiffer = 10;
constexpr double kMostOfBudget = .2;
constexpr int kFewestRepeats = 5;
constexpr double kInterval = .975;

/// 1 where the study's grains are as stiff as real ones.
double stiffness_of(const Experiment& experiment) {
  return std::min(kStiffer, experiment.real_stiffness);
}

bool is_of(const std::vector<Observable>& observables, const Experiment& experiment) {
  return std::ranges::any_of(observables, [&](const Observable& observable) {
    return observable.experiment == experiment.name;
  });
}

/// Repeats with this part of the study's stiffness.
void add_jobs(const Problem& problem, const Experiment& experiment,
              const std::vector<double>& values, int repeats, double stiffness,
              StiffnessPlan& plan) {
  for (int k = 0; k < (experiment.is_stochastic ? repeats : 1); ++k) {
    Job job = job_at(problem, experiment, to_unit(problem, values),
                     problem.settings.seed + kFirstStiffnessSeed + static_cast<std::uint64_t>(k));
    job.relative_stiffness = stiffness;
    plan.run_s += run_s_of(experiment, stiffness);
    plan.jobs.push_back(std::move(job));
  }
}

/// One experiment alone.
StiffnessPlan plan_of(const Problem& problem, const Experiment& experiment,
                      const std::vector<double>& values, int repeats) {
  StiffnessPlan plan;
  if (!is_of(problem.observables, experiment)) {
    add_jobs(problem, experiment, values, repeats, 1, plan);
  }
  add_jobs(problem, experiment, values, repeats, stiffness_of(experiment), plan);
  return plan;
}

/// The same with fewer repeats where so many take longer; none where the fewest do, too.
std::optional<StiffnessPlan> plan_within(double seconds, const Problem& problem,
                                         const Experiment& experiment,
                                         const std::vector<double>& values, int repeats) {
  for (int fewer = repeats; fewer >= std::min(kFewestRepeats, repeats); --fewer) {
    StiffnessPlan plan = plan_of(problem, experiment, values, fewer);
    if (plan.run_s <= seconds) return plan;
  }
  return std::nullopt;
}

/// A measured mean and its place in the fit; `fit` is null where it is held out.
struct Asked {
  const Observable& observable;
  const JointFit* fit;
  std::size_t number;

  UncertainMean mean(const CheckSample& sample, const Experiment& experiment) const {
    return mean_of(sample, experiment.is_stochastic, fit, number);
  }
};

/// Of the measured mean; a scatter that is only assumed counts as known.
double half_width_95(const Asked& asked) {
  constexpr double kKnown = 1e6;  // degrees of freedom: as good as normal
  const Observable& observable = asked.observable;
  return base::student_t_quantile(kInterval, observable.sd ? observable.n - 1 : kKnown) *
         (asked.fit != nullptr ? asked.fit->observables[asked.number].measured_uncertainty
                               : standard_uncertainty(observable));
}

void judge(const UncertainMean& change, double level, StiffnessCheck& check) {
  check.change = change.value;
  check.uncertainty = change.uncertainty;
  const double half = base::student_t_quantile(kInterval, change.df) * change.uncertainty;
  check.interval = {change.value - half, change.value + half};
  check.chance = chance_of(change);
  const Interval within = not_ruled_out(change);
  if (within.low >= -check.limit && within.high <= check.limit) {
    if (check.failed_runs == 0) check.verdict = AgreementVerdict::agrees;
  } else if (check.chance < level) {
    check.verdict = AgreementVerdict::disagrees;
  }
}

/// None where no stiffer grains were simulated.
std::optional<StiffnessCheck> check_of(const Problem& problem, const std::vector<double>& values,
                                       const std::vector<Run>& runs, const Asked& asked,
                                       double level) {
  const Observable& observable = asked.observable;
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  const double stiffness = stiffness_of(experiment);
  if (stiffness <= 1) return std::nullopt;
  const CheckSample stiffer = check_sample(problem, values, observable, runs, stiffness);
  const CheckSample own = check_sample(problem, values, observable, runs);
  if (stiffer.count() + stiffer.failed == 0) return std::nullopt;
  StiffnessCheck check{.name = observable.name,
                       .unit = observable.unit,
                       .stiffness = stiffness,
                       .stiffness_factor = stiffness / experiment.real_stiffness,
                       .change = kNone,
                       .uncertainty = kNone,
                       .interval = {kNone, kNone},
                       .chance = kNone,
                       .limit = half_width_95(asked),
                       .runs = stiffer.count(),
                       .failed_runs = stiffer.failed};
  if (stiffer.count() == 0 && own.count() > 0) check.verdict = AgreementVerdict::disagrees;
  const UncertainMean change =
      difference_of(asked.mean(stiffer, experiment), asked.mean(own, experiment));
  if (std::isfinite(change.value) && std::isfinite(change.uncertainty)) {
    judge(change, level, check);
  }
  return check;
}

}  // namespace

StiffnessPlan plan_stiffness(const Problem& problem, const std::vector<double>& values,
                             int repeats) {
  std::vector<Experiment> softened;
  for (const Experiment& experiment : problem.experiments) {
    const bool is_measured =
        is_of(problem.observables, experiment) || is_of(problem.held_out, experiment);
    if (is_measured && stiffness_of(experiment) > 1) softened.push_back(experiment);
  }
  std::ranges::stable_sort(softened, {}, [](const Experiment& experiment) {
    return run_s_of(experiment, stiffness_of(experiment));
  });
  StiffnessPlan plan;
  for (const Experiment& experiment : softened) {
    const double left_s = kMostOfBudget * problem.settings.budget_s - plan.run_s;
    const auto one = plan_within(left_s, problem, experiment, values, repeats);
    if (!one) {
      plan.too_dear.push_back(experiment.name);
      continue;
    }
    plan.run_s += one->run_s;
    plan.jobs.insert(plan.jobs.end(), one->jobs.begin(), one->jobs.end());
  }
  return plan;
}

std::vector<StiffnessCheck> check_stiffness(const Problem& problem,
                                            const std::vector<double>& values,
                                            const std::vector<Run>& runs, const JointFit& fit) {
  const double level =
      kLevel / static_cast<double>(problem.observables.size() + problem.held_out.size());
  std::vector<StiffnessCheck> checks;
  const auto add = [&](const Asked& asked) {
    const auto check = check_of(problem, values, runs, asked, level);
    if (check) checks.push_back(*check);
  };
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    add({problem.observables[i], &fit, i});
  }
  for (const Observable& observable : problem.held_out) add({observable, nullptr, 0});
  return checks;
}

}  // namespace repose::calibrate
