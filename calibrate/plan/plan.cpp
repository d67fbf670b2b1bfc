#include "calibrate/plan/plan.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/study/job_runner.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

namespace {

constexpr double kNearlyWhole = .97;

/// The better of two sets has the higher score; narrow intervals break ties.
struct Score {
  double determined = 0;
  double narrow = 0;

  auto operator<=>(const Score&) const = default;
};

Score score_of(const DesignForecast& outlook) {
  Score score;
  for (const double part : outlook.determined) score.determined += std::min(part, kEnough);
  for (const double width : outlook.widths) score.narrow += 1 - width;
  return score;
}

std::vector<std::size_t> to_be_done(const Foresight& foresight) {
  std::vector<std::size_t> places;
  const std::vector<ForecastTerm>& prospects = foresight.prospects();
  for (std::size_t i = 0; i < prospects.size(); ++i) {
    if (!prospects[i].is_measured && prospects[i].is_known) places.push_back(i);
  }
  return places;
}

/// The `places` whose bits are set.
std::vector<std::size_t> chosen(const std::vector<std::size_t>& places, unsigned bits) {
  std::vector<std::size_t> set;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if ((bits >> i & 1U) != 0) set.push_back(places[i]);
  }
  return set;
}

std::vector<std::size_t> best_set(const Foresight& foresight,
                                  const std::vector<std::size_t>& places) {
  const double enough = kNearlyWhole * score_of(foresight.with(places)).determined;
  std::vector<std::size_t> best = places;
  Score best_score = score_of(foresight.with(places));
  for (unsigned bits = 0; bits < 1U << places.size(); ++bits) {
    if (static_cast<std::size_t>(std::popcount(bits)) > best.size()) continue;
    const std::vector<std::size_t> set = chosen(places, bits);
    const Score score = score_of(foresight.with(set));
    if (score.determined < enough) continue;
    if (set.size() == best.size() && score.narrow <= best_score.narrow) continue;
    best = set;
    best_score = score;
  }
  return best;
}

}  // namespace

std::vector<PlannedStep> smallest_set(const Foresight& foresight) {
  std::vector<std::size_t> left = best_set(foresight, to_be_done(foresight));
  std::vector<std::size_t> done;
  std::vector<PlannedStep> steps;
  while (!left.empty()) {
    const auto score_with = [&](std::size_t next) {
      std::vector<std::size_t> set = done;
      set.push_back(next);
      return score_of(foresight.with(set));
    };
    const auto next = std::max_element(
        left.begin(), left.end(), [&](auto a, auto b) { return score_with(a) < score_with(b); });
    done.push_back(*next);
    left.erase(next);
    steps.push_back({done.back(), foresight.with(done)});
  }
  return steps;
}

namespace {

/// Makes runs one experiment after another, as the first round of a fit to all experiments.
class PlanRuns {
 public:
  PlanRuns(const OfferedStudy& offered, const StudyContext& context)
      : offered_(offered), context_(context), runner_(offered.problem, context) {}

  /// False if interrupted.
  bool make(Plan& plan) {
    std::map<std::string, std::vector<Job>> jobs;
    for (Job& job : plan_jobs(offered_)) {
      later_s_ += run_s_of(offered_.problem, job);
      jobs[job.experiment].push_back(std::move(job));
    }
    for (const Experiment& experiment : offered_.problem.experiments) {
      if (!make(experiment, jobs[experiment.name], plan)) return false;
    }
    plan.simulated = runner_.simulated();
    plan.reused = runner_.reused();
    return true;
  }

  const std::vector<Run>& runs() const { return runs_; }

 private:
  bool make(const Experiment& experiment, const std::vector<Job>& jobs, Plan& plan) {
    for (const Job& job : jobs) later_s_ -= run_s_of(offered_.problem, job);
    try {
      const auto done = runner_.get(experiment.name, jobs, later_s_);
      if (!done) return false;
      runs_.insert(runs_.end(), done->begin(), done->end());
      plan.run_s[experiment.name] = mean_wall_s(jobs);
    } catch (const base::InputError& error) {
      if (!offered_.added.contains(&dem::experiment_named(experiment.name))) throw;
      plan.notes.push_back(
          fmt::format("{} is left out: as it is usually done it cannot be run with "
                      "these grains. To have it in the plan, describe it in the "
                      "study. {}",
                      experiment.name, error.what()));
    }
    return true;
  }

  double mean_wall_s(const std::vector<Job>& jobs) const {
    double sum_s = 0;
    for (const Job& job : jobs) {
      const auto saved = context_.folder.find(context_.simulator.spec(job), job.seed);
      if (saved) sum_s += saved->wall_s;
    }
    return sum_s / static_cast<double>(jobs.size());
  }

  const OfferedStudy& offered_;
  const StudyContext& context_;
  JobRunner runner_;
  std::vector<Run> runs_;
  double later_s_ = 0;
};

}  // namespace

Budget plan_budget(double core_s) {
  Budget budget = budget_named("quick");
  budget.name = "plan";
  budget.settings.budget_s = core_s / kFirstFraction;
  budget.is_full = true;
  return budget;
}

std::vector<Job> plan_jobs(const OfferedStudy& offered) {
  Problem everything = offered.problem;
  everything.observables.clear();
  for (const Experiment& experiment : offered.problem.experiments) {
    Observable& observable = everything.observables.emplace_back();
    observable.name = observable.experiment = experiment.name;
  }
  return first_round(everything);
}

std::string foreseen(const OfferedStudy& offered, double asked_s) {
  constexpr double kMinute_s = 60, kMore = 1.1;
  std::map<std::string, int> counts;
  double all_s = 0;
  for (const Job& job : plan_jobs(offered)) {
    ++counts[job.experiment];
    all_s += run_s_of(offered.problem, job);
  }
  std::string parts;
  for (const auto& [experiment, count] : counts) {
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", experiment, count);
  }
  return fmt::format(
      "simulates {} for about {:.2g} minutes of one core, by the program's own measure{}", parts,
      all_s / kMinute_s,
      all_s > kMore * asked_s
          ? fmt::format(": more than the {:g} asked for, and the least that tells what these "
                        "experiments determine. Fix, to be faster: fewer or softer grains",
                        asked_s / kMinute_s)
          : std::string());
}

std::optional<Plan> make_plan(const OfferedStudy& offered, const StudyContext& context,
                              int readings) {
  Plan plan;
  plan.readings = readings;
  plan.notes = offered.notes;
  for (const Parameter& parameter : offered.problem.parameters) {
    plan.parameters.push_back(parameter.name);
  }
  PlanRuns runs(offered, context);
  if (!runs.make(plan)) return std::nullopt;
  try {
    const FitWatch watch(context.is_interrupted);
    const Foresight foresight(offered.problem, runs.runs(), readings);
    plan.prospects = foresight.prospects();
    plan.now = foresight.with({});
    plan.steps = smallest_set(foresight);
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  return plan;
}

namespace {

using Json = nlohmann::ordered_json;

Json by_parameter(const Plan& plan, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k) json[plan.parameters[k]] = values[k];
  return json;
}

void add(const Plan& plan, const DesignForecast& outlook, Json& json) {
  json["interval_widths"] = by_parameter(plan, outlook.widths);
  json["determined"] = by_parameter(plan, outlook.determined);
}

Json prospect_json(const Plan& plan, const ForecastTerm& prospect) {
  const auto run_s = plan.run_s.find(prospect.experiment);
  return {{"experiment", prospect.experiment},
          {"measured", prospect.is_measured},
          {"runs", prospect.runs},
          {"failed_runs", prospect.failed_runs},
          {"run_s", run_s == plan.run_s.end() ? Json(nullptr) : Json(run_s->second)},
          {"effects", prospect.is_known ? by_parameter(plan, prospect.effects) : Json(nullptr)}};
}

}  // namespace

std::string plan_json(const Plan& plan, const OfferedStudy& offered) {
  Json json = {{"study", offered.study.file.filename().string()},
               {"hash", offered.study.hash},
               {"readings", plan.readings},
               {"experiments", Json::array()},
               {"now", Json::object()},
               {"steps", Json::array()},
               {"notes", plan.notes}};
  for (const ForecastTerm& prospect : plan.prospects) {
    json["experiments"].push_back(prospect_json(plan, prospect));
  }
  add(plan, plan.now, json["now"]);
  for (const PlannedStep& step : plan.steps) {
    Json& added = json["steps"].emplace_back(
        Json{{"experiment", plan.prospects[step.experiment].experiment}});
    add(plan, step.outlook, added);
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::calibrate
