#include "calibrate/problem.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/core.h>

#include "calibrate/fit/budget.h"

namespace repose::calibrate {
namespace {

using Faults = std::vector<std::string>;

void check_parameter(const Parameter& parameter, Faults& faults) {
  const std::string& name = parameter.name;
  if (name.empty()) faults.push_back("a parameter has no name. Fix: name it");
  if (!std::isfinite(parameter.min) || !std::isfinite(parameter.max)) {
    faults.push_back(fmt::format("{}: min = {}, max = {} are not both numbers. Fix: give both",
                                 name, parameter.min, parameter.max));
  } else if (parameter.min >= parameter.max) {
    faults.push_back(
        fmt::format("{}: min = {} is not below max = {}. Fix: swap or widen them, or "
                    "give the one value as known",
                    name, parameter.min, parameter.max));
  }
  if (!parameter.prior) return;
  const Prior& prior = *parameter.prior;
  if (!std::isfinite(prior.mean) || !std::isfinite(prior.sd) || prior.sd <= 0) {
    faults.push_back(
        fmt::format("{}: known beforehand as {} +- {}: both must be numbers, the sd "
                    "above 0. Fix: give the sd, or leave the knowledge out",
                    name, prior.mean, prior.sd));
  } else if (prior.mean < parameter.min || prior.mean > parameter.max) {
    faults.push_back(
        fmt::format("{}: known beforehand as {}, outside {} ... {}. Fix: widen the "
                    "bounds",
                    name, prior.mean, parameter.min, parameter.max));
  }
}

void check_experiment(const Problem& problem, const Experiment& experiment, Faults& faults) {
  const std::string where = "experiment " + experiment.name;
  if (!std::isfinite(experiment.run_s) || experiment.run_s <= 0) {
    faults.push_back(fmt::format("{}: run_s = {} must be a number above 0. Fix: estimate it", where,
                                 experiment.run_s));
  }
  std::set<std::size_t> seen;
  for (const std::size_t i : experiment.parameters) {
    if (i >= problem.parameters.size()) {
      faults.push_back(fmt::format("{}: depends on parameter {}, of {}. Fix: count from 0", where,
                                   i, problem.parameters.size()));
    } else if (!seen.insert(i).second) {
      faults.push_back(fmt::format("{}: depends on {} twice. Fix: name it once", where,
                                   problem.parameters[i].name));
    }
  }
}

void check_scatter(const Observable& observable, Faults& faults) {
  const std::string& name = observable.name;
  const auto& share = observable.assumed_sd_share;
  if (observable.sd) {
    if (!std::isfinite(*observable.sd) || *observable.sd <= 0) {
      faults.push_back(
          fmt::format("{}: sd = {} must be a number above 0: readings without any "
                      "scatter would make every simulation wrong. Fix: give the "
                      "instrument's resolution as sd",
                      name, *observable.sd));
    }
    if (observable.n == 1) {
      faults.push_back(
          fmt::format("{}: one reading has no sd. Fix: repeat it, or assume a scatter "
                      "(assumed_sd_share)",
                      name));
    }
  } else if (!share) {
    faults.push_back(
        fmt::format("{}: nothing is known of the readings' scatter. Fix: give sd, or "
                    "assume one (assumed_sd_share)",
                    name));
  } else if (!std::isfinite(*share) || *share <= 0) {
    faults.push_back(fmt::format(
        "{}: assumed_sd_share = {} must be a number above 0. Fix: .05 is 5 %", name, *share));
  } else if (observable.mean == 0) {
    faults.push_back(fmt::format("{}: a share of a mean of 0 is no scatter. Fix: give sd", name));
  }
}

void check_observable(const Problem& problem, const Observable& observable, Faults& faults) {
  const std::string& name = observable.name;
  const auto experiment =
      std::find_if(problem.experiments.begin(), problem.experiments.end(),
                   [&](const Experiment& e) { return e.name == observable.experiment; });
  if (experiment == problem.experiments.end()) {
    faults.push_back(
        fmt::format("{}: no experiment is called \"{}\". Fix: add it, or correct the "
                    "name",
                    name, observable.experiment));
  } else if (experiment->parameters.empty()) {
    faults.push_back(
        fmt::format("{}: its experiment, {}, depends on no parameter that is sought. "
                    "Fix: leave the observable out",
                    name, experiment->name));
  }
  if (!std::isfinite(observable.mean)) {
    faults.push_back(
        fmt::format("{}: mean = {} is not a number. Fix: give it, or leave the "
                    "observable out",
                    name, observable.mean));
  }
  if (observable.n < 1) {
    faults.push_back(
        fmt::format("{}: n = {} must be 1 or more. Fix: count the readings", name, observable.n));
  }
  check_scatter(observable, faults);
}

template <typename Things>
void check_names(const Things& things, const char* what, Faults& faults) {
  std::set<std::string> names;
  for (const auto& thing : things) {
    if (!names.insert(thing.name).second) {
      faults.push_back(fmt::format("two {} are called \"{}\". Fix: rename one", what, thing.name));
    }
  }
}

/// Parameters that nothing measured depends on.
void check_dependence(const Problem& problem, Faults& faults) {
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    const auto depends = [&](const Experiment& experiment) {
      return std::find(experiment.parameters.begin(), experiment.parameters.end(), i) !=
             experiment.parameters.end();
    };
    const bool seen = std::any_of(
        problem.observables.begin(), problem.observables.end(), [&](const Observable& observable) {
          return std::any_of(problem.experiments.begin(), problem.experiments.end(),
                             [&](const Experiment& experiment) {
                               return experiment.name == observable.experiment &&
                                      depends(experiment);
                             });
        });
    if (seen) continue;
    std::string able;
    for (const Experiment& experiment : problem.experiments) {
      if (depends(experiment)) able += (able.empty() ? "" : " or ") + experiment.name;
    }
    faults.push_back(
        fmt::format("{}: nothing that was measured depends on it. Fix: give it a value"
                    "{}",
                    problem.parameters[i].name, able.empty() ? "" : ", or measure " + able));
  }
}

void check_settings(const Problem& problem, Faults& faults) {
  const FitSettings& settings = problem.settings;
  if (settings.most_rounds < 1) {
    faults.push_back(
        fmt::format("most_rounds = {} must be 1 or more. Fix: 6 is usual", settings.most_rounds));
  }
  // Costs are only meaningful once the rest is.
  if (!faults.empty()) return;
  const Expense least = least_expense(problem);
  if (!(settings.budget_s >= least.seconds)) {
    faults.push_back(
        fmt::format("budget_s = {}: the fewest runs that a fit can be made of take "
                    "{:.0f} s. Fix: allow that, or measure fewer experiments",
                    settings.budget_s, std::ceil(least.seconds)));
  }
  if (settings.most_jobs < least.jobs) {
    faults.push_back(fmt::format("most_jobs = {}: a fit takes at least {}. Fix: allow that",
                                 settings.most_jobs, least.jobs));
  }
}

}  // namespace

std::vector<std::string> faults_of(const Problem& problem) {
  Faults faults;
  if (problem.parameters.empty()) {
    faults.push_back("no parameter is sought. Fix: give at least one its bounds");
  }
  if (problem.observables.empty()) {
    faults.push_back("nothing was measured. Fix: give at least one observable");
  }
  check_names(problem.parameters, "parameters", faults);
  check_names(problem.experiments, "experiments", faults);
  check_names(problem.observables, "observables", faults);
  for (const Parameter& parameter : problem.parameters) check_parameter(parameter, faults);
  for (const Experiment& experiment : problem.experiments) {
    check_experiment(problem, experiment, faults);
  }
  for (const Observable& observable : problem.observables) {
    check_observable(problem, observable, faults);
  }
  check_dependence(problem, faults);
  check_settings(problem, faults);
  return faults;
}

void require_sound(const Problem& problem) {
  std::string text;
  for (const std::string& fault : faults_of(problem)) text += (text.empty() ? "" : "\n") + fault;
  if (!text.empty()) throw std::invalid_argument(text);
}

double standard_uncertainty(const Observable& observable) {
  const double sd = observable.sd
                        ? *observable.sd
                        : observable.assumed_sd_share.value_or(0) * std::abs(observable.mean);
  return sd / std::sqrt(static_cast<double>(observable.n));
}

}  // namespace repose::calibrate
