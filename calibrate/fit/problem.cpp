#include "calibrate/fit/problem.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/core.h>

#include "calibrate/fit/budget.h"

namespace repose::calibrate {
namespace {

using ErrorList = std::vector<std::string>;

void check_parameter(const Parameter& parameter, ErrorList& errors) {
  const std::string& name = parameter.name;
  if (name.empty()) errors.emplace_back("a parameter has no name. Fix: name it");
  if (!std::isfinite(parameter.min) || !std::isfinite(parameter.max)) {
    errors.push_back(fmt::format("{}: min = {}, max = {} are not both numbers. Fix: give both",
                                 name, parameter.min, parameter.max));
  } else if (parameter.min >= parameter.max) {
    errors.push_back(
        fmt::format("{}: min = {} is not below max = {}. Fix: swap or widen them, or "
                    "give the one value as known",
                    name, parameter.min, parameter.max));
  }
  if (parameter.useful_half_width &&
      (!std::isfinite(*parameter.useful_half_width) || *parameter.useful_half_width <= 0)) {
    errors.push_back(fmt::format(
        "{}: useful_half_width = {} must be a number above 0. Fix: leave it out, or give half the "
        "width of an interval that is narrow enough",
        name, *parameter.useful_half_width));
  }
  if (!parameter.prior) return;
  const Prior& prior = *parameter.prior;
  if (!std::isfinite(prior.mean) || !std::isfinite(prior.sd) || prior.sd <= 0) {
    errors.push_back(
        fmt::format("{}: known beforehand as {} +- {}: both must be numbers, the sd "
                    "above 0. Fix: give the sd, or leave the knowledge out",
                    name, prior.mean, prior.sd));
  } else if (prior.mean < parameter.min || prior.mean > parameter.max) {
    errors.push_back(
        fmt::format("{}: known beforehand as {}, outside {} ... {}. Fix: widen the "
                    "bounds",
                    name, prior.mean, parameter.min, parameter.max));
  }
}

void check_experiment(const Problem& problem, const Experiment& experiment, ErrorList& errors) {
  const std::string where = "experiment " + experiment.name;
  if (!std::isfinite(experiment.run_s) || experiment.run_s <= 0) {
    errors.push_back(fmt::format("{}: run_s = {} must be a number above 0. Fix: estimate it", where,
                                 experiment.run_s));
  }
  if (!std::isfinite(experiment.real_stiffness) || experiment.real_stiffness < 1) {
    errors.push_back(fmt::format(
        "{}: real_stiffness = {} must be 1 or more. Fix: 1 where grains are not softened", where,
        experiment.real_stiffness));
  }
  if (!std::isfinite(experiment.spheres_share) || experiment.spheres_share < 0) {
    errors.push_back(fmt::format("{}: spheres_share = {} must be 0 or more. Fix: estimate it",
                                 where, experiment.spheres_share));
  }
  if (experiment.readings_per_run < 1) {
    errors.push_back(fmt::format("{}: readings_per_run = {} must be 1 or more. Fix: count them",
                                 where, experiment.readings_per_run));
  }
  std::set<std::size_t> seen;
  for (const std::size_t i : experiment.parameters) {
    if (i >= problem.parameters.size()) {
      errors.push_back(fmt::format("{}: depends on parameter {}, of {}. Fix: count from 0", where,
                                   i, problem.parameters.size()));
    } else if (!seen.insert(i).second) {
      errors.push_back(fmt::format("{}: depends on {} twice. Fix: name it once", where,
                                   problem.parameters[i].name));
    }
  }
}

void check_scatter(const Observable& observable, ErrorList& errors) {
  const std::string& name = observable.name;
  const auto& fraction = observable.assumed_sd_fraction;
  if (observable.sd) {
    if (!std::isfinite(*observable.sd) || *observable.sd <= 0) {
      errors.push_back(
          fmt::format("{}: sd = {} must be a number above 0: readings without any "
                      "scatter would make every simulation wrong. Fix: give the "
                      "instrument's resolution as sd",
                      name, *observable.sd));
    }
    if (observable.n == 1) {
      errors.push_back(
          fmt::format("{}: one reading has no sd. Fix: repeat it, or assume a scatter "
                      "(assumed_sd_share)",
                      name));
    }
  } else if (!fraction) {
    errors.push_back(
        fmt::format("{}: nothing is known of the readings' scatter. Fix: give sd, or "
                    "assume one (assumed_sd_share)",
                    name));
  } else if (!std::isfinite(*fraction) || *fraction <= 0) {
    errors.push_back(fmt::format(
        "{}: assumed_sd_share = {} must be a number above 0. Fix: .05 is 5 %", name, *fraction));
  } else if (observable.mean == 0) {
    errors.push_back(
        fmt::format("{}: a fraction of a mean of 0 is no scatter. Fix: give sd", name));
  }
}

void check_observable(const Problem& problem, const Observable& observable, ErrorList& errors) {
  const std::string& name = observable.name;
  const auto experiment =
      std::find_if(problem.experiments.begin(), problem.experiments.end(),
                   [&](const Experiment& e) { return e.name == observable.experiment; });
  if (experiment == problem.experiments.end()) {
    errors.push_back(
        fmt::format("{}: no experiment is called \"{}\". Fix: add it, or correct the "
                    "name",
                    name, observable.experiment));
  } else if (experiment->parameters.empty()) {
    errors.push_back(
        fmt::format("{}: its experiment, {}, depends on no parameter that is sought. "
                    "Fix: leave the observable out",
                    name, experiment->name));
  }
  if (!std::isfinite(observable.mean)) {
    errors.push_back(
        fmt::format("{}: mean = {} is not a number. Fix: give it, or leave the "
                    "observable out",
                    name, observable.mean));
  }
  if (observable.n < 1) {
    errors.push_back(
        fmt::format("{}: n = {} must be 1 or more. Fix: count the readings", name, observable.n));
  }
  if (observable.tolerance &&
      !(*observable.tolerance > 0 && std::isfinite(*observable.tolerance))) {
    errors.push_back(fmt::format(
        "{}: tolerance = {} must be a number above 0: no two means are ever equal. Fix: "
        "the difference that does not matter to you, or leave it out",
        name, *observable.tolerance));
  }
  if (!(observable.systematic_sd >= 0 && std::isfinite(observable.systematic_sd))) {
    errors.push_back(fmt::format(
        "{}: what its readings share has the standard uncertainty {}. Rule: a number of 0 or more. "
        "Fix: correct it (bias_sd), or leave it out",
        name, observable.systematic_sd));
  }
  if (!(observable.model_sd >= 0 && std::isfinite(observable.model_sd))) {
    errors.push_back(
        fmt::format("{}: the model's error has the standard deviation {}. Rule: a number of 0 or "
                    "more. Fix: model_error, a fraction of the reading",
                    name, observable.model_sd));
  }
  check_scatter(observable, errors);
}

/// Where a reading of an experiment is fitted, its others predict nothing new.
void check_not_fitted(const Problem& problem, const Observable& held_out, ErrorList& errors) {
  const bool is_fitted = std::ranges::any_of(problem.observables, [&](const Observable& fitted) {
    return fitted.experiment == held_out.experiment;
  });
  if (!is_fitted) return;
  errors.push_back(
      fmt::format("{}: held out, but other readings of {} are fitted. Fix: hold out all of them",
                  held_out.name, held_out.experiment));
}

template <typename Things>
void check_names(const Things& things, const char* what, ErrorList& errors) {
  std::set<std::string> names;
  for (const auto& thing : things) {
    if (!names.insert(thing.name).second) {
      errors.push_back(fmt::format("two {} are called \"{}\". Fix: rename one", what, thing.name));
    }
  }
}

void check_settings(const Problem& problem, ErrorList& errors) {
  const FitSettings& settings = problem.settings;
  if (settings.max_rounds < 1) {
    errors.push_back(
        fmt::format("max_rounds = {} must be 1 or more. Fix: 6 is usual", settings.max_rounds));
  }
  // Costs are only meaningful once the rest is.
  if (!errors.empty()) return;
  const Cost least = minimum_cost(problem);
  if (!(settings.budget_s >= least.seconds)) {
    errors.push_back(
        fmt::format("budget_s = {}: the fewest runs that a fit can be made of take "
                    "{:.0f} s. Fix: allow that, or measure fewer experiments",
                    settings.budget_s, std::ceil(least.seconds)));
  }
  if (settings.max_jobs < least.jobs) {
    errors.push_back(fmt::format("max_jobs = {}: a fit takes at least {}. Fix: allow that",
                                 settings.max_jobs, least.jobs));
  }
}

}  // namespace

std::vector<std::string> errors_of(const Problem& problem) {
  ErrorList errors;
  if (problem.parameters.empty()) {
    errors.emplace_back("no parameter is sought. Fix: give at least one its bounds");
  }
  if (problem.observables.empty()) {
    errors.emplace_back("nothing was measured. Fix: give at least one observable");
  }
  check_names(problem.parameters, "parameters", errors);
  check_names(problem.experiments, "experiments", errors);
  check_names(problem.observables, "observables", errors);
  check_names(problem.held_out, "observables that are held out", errors);
  for (const Parameter& parameter : problem.parameters) check_parameter(parameter, errors);
  for (const Experiment& experiment : problem.experiments) {
    check_experiment(problem, experiment, errors);
  }
  for (const Observable& observable : problem.observables) {
    check_observable(problem, observable, errors);
  }
  for (const Observable& observable : problem.held_out) {
    check_observable(problem, observable, errors);
    check_not_fitted(problem, observable, errors);
  }
  check_settings(problem, errors);
  return errors;
}

void require_sound(const Problem& problem) {
  std::string text;
  for (const std::string& error : errors_of(problem)) text += (text.empty() ? "" : "\n") + error;
  if (!text.empty()) throw std::invalid_argument(text);
}

bool leaves_one_value(const Parameter& parameter, double value, double half_width) {
  constexpr double kNarrow = .25;
  return half_width <= kNarrow * std::abs(value) ||
         half_width <= parameter.useful_half_width.value_or(0);
}

double standard_uncertainty(const Observable& observable) {
  const double sd = observable.sd
                        ? *observable.sd
                        : observable.assumed_sd_fraction.value_or(0) * std::abs(observable.mean);
  return sd / std::sqrt(static_cast<double>(observable.n));
}

double with_systematic(const Observable& observable, double by_scatter) {
  return std::hypot(by_scatter, observable.systematic_sd);
}

}  // namespace repose::calibrate
