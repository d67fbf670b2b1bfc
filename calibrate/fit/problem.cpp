#include "calibrate/fit/problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/core.h>

#include "calibrate/fit/budget.h"

namespace repose::calibrate {
namespace {

void check_parameter(const Parameter& parameter, std::vector<base::Fault>& errors) {
  const std::string& name = parameter.name;
  if (name.empty()) errors.push_back({.value = "a parameter has no name", .fix = "name it"});
  if (!std::isfinite(parameter.min) || !std::isfinite(parameter.max)) {
    errors.push_back(
        {.where = name,
         .subject = "min",
         .value = fmt::format("= {}, max = {} are not both numbers", parameter.min, parameter.max),
         .fix = "give both"});
  } else if (parameter.min >= parameter.max) {
    errors.push_back(
        {.where = name,
         .subject = "min",
         .value = fmt::format("= {} is not below max = {}", parameter.min, parameter.max),
         .fix = "swap or widen them, or give the one value as known"});
  }
  if (parameter.useful_half_width &&
      (!std::isfinite(*parameter.useful_half_width) || *parameter.useful_half_width <= 0)) {
    errors.push_back(
        {.where = name,
         .subject = "useful_half_width",
         .value = fmt::format("= {}", *parameter.useful_half_width),
         .rule = "must be a number above 0",
         .fix = "leave it out, or give half the width of an interval that is narrow enough"});
  }
  if (!parameter.prior) return;
  const Prior& prior = *parameter.prior;
  if (!std::isfinite(prior.mean) || !std::isfinite(prior.sd) || prior.sd <= 0) {
    errors.push_back(
        {.where = name,
         .value = fmt::format("known beforehand as {} +- {}: both", prior.mean, prior.sd),
         .rule = "must be numbers, the sd above 0",
         .fix = "give the sd, or leave the knowledge out"});
  } else if (prior.mean < parameter.min || prior.mean > parameter.max) {
    errors.push_back({.where = name,
                      .value = fmt::format("known beforehand as {}, outside {} ... {}", prior.mean,
                                           parameter.min, parameter.max),
                      .fix = "widen the bounds"});
  }
}

void check_experiment(const Problem& problem, const Experiment& experiment,
                      std::vector<base::Fault>& errors) {
  const std::string where = "experiment " + experiment.name;
  if (!std::isfinite(experiment.run_s) || experiment.run_s <= 0) {
    errors.push_back({.where = where,
                      .subject = "run_s",
                      .value = fmt::format("= {}", experiment.run_s),
                      .rule = "must be a number above 0",
                      .fix = "estimate it"});
  }
  if (!std::isfinite(experiment.real_stiffness) || experiment.real_stiffness < 1) {
    errors.push_back({.where = where,
                      .subject = "real_stiffness",
                      .value = fmt::format("= {}", experiment.real_stiffness),
                      .rule = "must be 1 or more",
                      .fix = "1 where grains are not softened"});
  }
  if (!std::isfinite(experiment.spheres_share) || experiment.spheres_share < 0) {
    errors.push_back({.where = where,
                      .subject = "spheres_share",
                      .value = fmt::format("= {}", experiment.spheres_share),
                      .rule = "must be 0 or more",
                      .fix = "estimate it"});
  }
  if (experiment.readings_per_run < 1) {
    errors.push_back({.where = where,
                      .subject = "readings_per_run",
                      .value = fmt::format("= {}", experiment.readings_per_run),
                      .rule = "must be 1 or more",
                      .fix = "count them"});
  }
  std::set<std::size_t> seen;
  for (const std::size_t i : experiment.parameters) {
    if (i >= problem.parameters.size()) {
      errors.push_back(
          {.where = where,
           .value = fmt::format("depends on parameter {}, of {}", i, problem.parameters.size()),
           .fix = "count from 0"});
    } else if (!seen.insert(i).second) {
      errors.push_back({.where = where,
                        .value = fmt::format("depends on {} twice", problem.parameters[i].name),
                        .fix = "name it once"});
    }
  }
}

void check_scatter(const Observable& observable, std::vector<base::Fault>& errors) {
  const std::string& name = observable.name;
  const auto& fraction = observable.assumed_sd_fraction;
  if (observable.sd) {
    if (!std::isfinite(*observable.sd) || *observable.sd <= 0) {
      errors.push_back({.where = name,
                        .subject = "sd",
                        .value = fmt::format("= {}", *observable.sd),
                        .rule = "must be a number above 0: readings without any scatter would make "
                                "every simulation wrong",
                        .fix = "give the instrument's resolution as sd"});
    }
    if (observable.n == 1 && !observable.is_sd_known) {
      errors.push_back({.where = name,
                        .value = "one reading has no sd",
                        .fix = "repeat it, or assume a scatter (assumed_sd_share)"});
    }
  } else if (!fraction) {
    errors.push_back({.where = name,
                      .value = "nothing is known of the readings' scatter",
                      .fix = "give sd, or assume one (assumed_sd_share)"});
  } else if (!std::isfinite(*fraction) || *fraction <= 0) {
    errors.push_back({.where = name,
                      .subject = "assumed_sd_share",
                      .value = fmt::format("= {}", *fraction),
                      .rule = "must be a number above 0",
                      .fix = ".05 is 5 %"});
  } else if (observable.mean == 0) {
    errors.push_back(
        {.where = name, .value = "a fraction of a mean of 0 is no scatter", .fix = "give sd"});
  }
}

void check_observable(const Problem& problem, const Observable& observable,
                      std::vector<base::Fault>& errors) {
  const std::string& name = observable.name;
  const auto experiment =
      std::find_if(problem.experiments.begin(), problem.experiments.end(),
                   [&](const Experiment& e) { return e.name == observable.experiment; });
  if (experiment == problem.experiments.end()) {
    errors.push_back({.where = name,
                      .value = fmt::format("no experiment is called \"{}\"", observable.experiment),
                      .fix = "add it, or correct the name"});
  } else if (experiment->parameters.empty()) {
    errors.push_back(
        {.where = name,
         .value = fmt::format("its experiment, {}, depends on no parameter that is sought",
                              experiment->name),
         .fix = "leave the observable out"});
  }
  if (!std::isfinite(observable.mean)) {
    errors.push_back({.where = name,
                      .subject = "mean",
                      .value = fmt::format("= {} is not a number", observable.mean),
                      .fix = "give it, or leave the observable out"});
  }
  if (observable.n < 1) {
    errors.push_back({.where = name,
                      .value = fmt::format("n = {}", observable.n),
                      .rule = "must be 1 or more",
                      .fix = "count the readings"});
  }
  if (observable.tolerance &&
      !(*observable.tolerance > 0 && std::isfinite(*observable.tolerance))) {
    errors.push_back({.where = name,
                      .subject = "tolerance",
                      .value = fmt::format("= {}", *observable.tolerance),
                      .rule = "must be a number above 0: no two means are ever equal",
                      .fix = "the difference that does not matter to you, or leave it out"});
  }
  if (!(observable.systematic_sd >= 0 && std::isfinite(observable.systematic_sd))) {
    errors.push_back(
        {.where = name,
         .value = fmt::format("what its readings share has the standard uncertainty {}",
                              observable.systematic_sd),
         .rule = "a number of 0 or more",
         .fix = "correct it (bias_sd), or leave it out"});
  }
  if (!(observable.model_sd >= 0 && std::isfinite(observable.model_sd))) {
    errors.push_back({.where = name,
                      .value = fmt::format("the model's error has the standard deviation {}",
                                           observable.model_sd),
                      .rule = "a number of 0 or more",
                      .fix = "model_error, a fraction of the reading"});
  }
  check_scatter(observable, errors);
}

/// Where a reading of an experiment is fitted, its others predict nothing new.
void check_not_fitted(const Problem& problem, const Observable& held_out,
                      std::vector<base::Fault>& errors) {
  const bool is_fitted = std::ranges::any_of(problem.observables, [&](const Observable& fitted) {
    return fitted.experiment == held_out.experiment;
  });
  if (!is_fitted) return;
  errors.push_back(
      {.where = held_out.name,
       .value = fmt::format("held out, but other readings of {} are fitted", held_out.experiment),
       .fix = "hold out all of them"});
}

template <typename Things>
void check_names(const Things& things, const char* what, std::vector<base::Fault>& errors) {
  std::set<std::string> names;
  for (const auto& thing : things) {
    if (!names.insert(thing.name).second) {
      errors.push_back({.value = fmt::format("two {} are called \"{}\"", what, thing.name),
                        .fix = "rename one"});
    }
  }
}

void check_settings(const Problem& problem, std::vector<base::Fault>& errors) {
  const FitSettings& settings = problem.settings;
  if (settings.max_rounds < 1) {
    errors.push_back({.subject = "max_rounds",
                      .value = fmt::format("= {}", settings.max_rounds),
                      .rule = "must be 1 or more",
                      .fix = "6 is usual"});
  }
  // Costs are only meaningful once the rest is.
  if (!errors.empty()) return;
  const Cost least = minimum_cost(problem);
  if (!(settings.budget_s >= least.seconds)) {
    errors.push_back(
        {.subject = "budget_s",
         .value = fmt::format("= {}: the fewest runs that a fit can be made of take {:.0f} s",
                              settings.budget_s, std::ceil(least.seconds)),
         .fix = "allow that, or measure fewer experiments"});
  }
  if (settings.max_jobs < least.jobs) {
    errors.push_back(
        {.subject = "max_jobs",
         .value = fmt::format("= {}: a fit takes at least {}", settings.max_jobs, least.jobs),
         .fix = "allow that"});
  }
}

}  // namespace

std::vector<base::Fault> errors_of(const Problem& problem) {
  std::vector<base::Fault> errors;
  if (problem.parameters.empty()) {
    errors.push_back({.value = "no parameter is sought", .fix = "give at least one its bounds"});
  }
  if (problem.observables.empty()) {
    errors.push_back({.value = "nothing was measured", .fix = "give at least one observable"});
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
  std::vector<base::Fault> errors = errors_of(problem);
  if (!errors.empty()) throw base::InputError(std::move(errors));
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

double degrees_of_scatter(const Observable& observable) {
  if (!observable.sd || observable.is_sd_known) return std::numeric_limits<double>::infinity();
  return observable.n - 1;
}

double with_systematic(const Observable& observable, double by_scatter) {
  return std::hypot(by_scatter, observable.systematic_sd);
}

}  // namespace repose::calibrate
