#include "cli/calibrate/calibrate_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "calibrate/study/study_simulator.h"
#include "cli/calibrate/calibrate_json.h"
#include "cli/common/terminal.h"
#include "cli/simulate/simulate_json.h"
#include "dem/contact/rolling_name.h"

namespace repose::cli {

std::string short_name(const std::string& coefficient) {
  constexpr std::string_view kPrefix = "contact.";
  return coefficient.starts_with(kPrefix) ? coefficient.substr(kPrefix.size()) : coefficient;
}

namespace {

/// "0.310", or with as many digits as a quantity of that size needs.
std::string number(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size < 10 ? 3 : size < 100 ? 2 : 1);
}

std::string parameters_text(const calibrate::JointFit& fit) {
  std::string text = fmt::format("{}{:>8}   {}verdict\n", padded("coefficient", 34), "value",
                                 padded("95 % interval", 19));
  for (const calibrate::FittedParameter& parameter : fit.parameters) {
    const std::string interval =
        fmt::format("{} … {}", number(parameter.interval.low), number(parameter.interval.high));
    text += fmt::format("{}{:>8}   {}{}\n", padded(short_name(parameter.name), 34),
                        number(parameter.value), padded(interval, 19), name_of(parameter.verdict));
  }
  return text;
}

std::string observables_text(const calibrate::StudyOutcome& outcome) {
  std::string text =
      fmt::format("\n{}{}{}{:>12}\n", padded("observable", 22), right_aligned("measured", 18),
                  right_aligned("simulated", 20), "off [sigma]");
  for (std::size_t k = 0; k < outcome.fit.observables.size(); ++k) {
    const calibrate::FittedObservable& observable = outcome.fit.observables[k];
    const calibrate::Agreement& checked = outcome.best.observables[k];
    const std::string name = observable.unit.empty()
                                 ? observable.name
                                 : fmt::format("{} [{}]", observable.name, observable.unit);
    const auto pair = [](double value, double uncertainty) {
      return fmt::format("{} ± {}", number(value), number(uncertainty));
    };
    text += fmt::format(
        "{}{}{}{:>12}\n", padded(name, 22),
        right_aligned(pair(observable.measured, observable.measured_uncertainty), 18),
        right_aligned(pair(checked.simulated, checked.simulated_uncertainty), 20),
        std::isfinite(checked.difference_sigma) ? fmt::format("{:+.1f}", checked.difference_sigma)
                                                : "–");
  }
  return text +
         fmt::format(
             "(± is the standard uncertainty of the mean; simulated with fresh seeds: {})\n",
             outcome.best.agrees ? "agrees with the bench" : "does NOT agree with the bench");
}

std::string family_text(const calibrate::StudyOutcome& outcome) {
  const auto& family = outcome.fit.equivalence_family;
  if (family.empty()) return {};
  std::string text = "\nsets that fit as well, in the order of the coefficients above\n";
  for (std::size_t k = 0; k < family.size(); ++k) {
    std::string line = " ";
    for (const double value : family[k].values) line += fmt::format("{:>8}", number(value));
    if (k < outcome.family.size()) {
      line += outcome.family[k].agrees ? "   simulated: agrees" : "   simulated: does not agree";
    }
    text += line + '\n';
  }
  return text;
}

std::string advice_text(const calibrate::JointFit& fit, std::size_t width) {
  std::string text;
  std::set<std::string> told;
  for (const calibrate::FittedParameter& parameter : fit.parameters) {
    if (parameter.advice.empty()) continue;
    const std::string line = fmt::format("{} is {}: {}", short_name(parameter.name),
                                         name_of(parameter.verdict), parameter.advice);
    if (!told.insert(line).second) continue;
    text += '\n';
    for (const std::string& part : wrapped(line, width)) text += part + '\n';
  }
  return text;
}

std::string belongs_to_text(const CalibratePlan& plan, std::size_t width) {
  std::string stiffness;
  for (const calibrate::Experiment& experiment : plan.problem.problem.experiments) {
    const double factor =
        dem::model_for(plan.record.study, dem::experiment_named(experiment.name).experiment)
            .stiffness_factor;
    stiffness += fmt::format("{}{} {:g}", stiffness.empty() ? "" : ", ", experiment.name, factor);
  }
  const std::size_t spheres = plan.record.grain.shape.spheres.size();
  const std::string text = fmt::format(
      "These coefficients belong to: {}, rolling friction {} ({}); a clump of {} ({}, "
      "volume {:+.2f} % off); stiffness factor {}; budget {}: {}.",
      contact_model_text(), dem::name_of(plan.record.study.model.rolling),
      rolling_definition(plan.record.study.model.rolling),
      spheres == 1 ? "1 sphere" : fmt::format("{} spheres", spheres), plan.record.grain.source,
      100 * plan.record.grain.errors.volume_error, stiffness, plan.record.budget.name,
      plan.record.budget.description);
  std::string lines = "\n";
  for (const std::string& part : wrapped(text, width)) lines += part + '\n';
  return lines;
}

}  // namespace

std::string calibrate_table(const CalibratePlan& plan, const calibrate::StudyOutcome& outcome,
                            int columns) {
  constexpr int kWidest = 100;
  const auto width = static_cast<std::size_t>(std::clamp(columns, 40, kWidest));
  return parameters_text(outcome.fit) + observables_text(outcome) + family_text(outcome) +
         advice_text(outcome.fit, width) + belongs_to_text(plan, width);
}

}  // namespace repose::cli
