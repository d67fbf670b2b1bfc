#include "cli/calibrate/calibrate_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "cli/common/terminal.h"

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

std::string parameters_text(const calibrate::JointResult& joint) {
  std::string text = fmt::format("{}{:>8}   {}verdict\n", padded("coefficient", 34), "value",
                                 padded("95 % interval", 19));
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    const std::string interval =
        fmt::format("{} … {}", number(parameter.interval.low), number(parameter.interval.high));
    text += fmt::format("{}{:>8}   {}{}\n", padded(short_name(parameter.name), 34),
                        number(parameter.value), padded(interval, 19), name_of(parameter.verdict));
  }
  return text;
}

std::string observables_text(const calibrate::JointResult& joint) {
  std::string text =
      fmt::format("\n{}{}{}{:>16}\n", padded("observable", 22), right_aligned("measured", 18),
                  right_aligned("simulated", 20), "difference / σ");
  for (const calibrate::ResultObservable& observable : joint.observables) {
    const calibrate::ObservableCheck& checked = observable.verification;
    const std::string name = observable.unit.empty()
                                 ? observable.name
                                 : fmt::format("{} [{}]", observable.name, observable.unit);
    const auto pair = [](double value, double uncertainty) {
      return fmt::format("{} ± {}", number(value), number(uncertainty));
    };
    text += fmt::format(
        "{}{}{}{:>16}\n", padded(name, 22),
        right_aligned(pair(observable.measured, observable.measured_uncertainty), 18),
        right_aligned(pair(checked.simulated, checked.uncertainty), 20),
        std::isfinite(checked.difference_sigma) ? fmt::format("{:+.1f}", checked.difference_sigma)
                                                : "–");
  }
  return text + fmt::format(
                    "(± is the standard uncertainty of the mean; simulated with fresh seeds: {})\n",
                    joint.verified ? "agrees with the bench" : "does NOT agree with the bench");
}

std::string family_text(const calibrate::JointResult& joint) {
  if (joint.equivalence_family.empty()) return {};
  std::string text = "\nequally good parameter sets, in the order of the coefficients above\n";
  for (const calibrate::EquivalentSet& set : joint.equivalence_family) {
    std::string line = " ";
    for (const double value : set.values) line += fmt::format("{:>8}", number(value));
    if (set.verified)
      line += *set.verified ? "   simulated: agrees" : "   simulated: does not agree";
    text += line + '\n';
  }
  return text;
}

std::string advice_text(const calibrate::JointResult& joint, std::size_t width) {
  std::string text;
  std::set<std::string> told;
  for (const calibrate::ResultParameter& parameter : joint.parameters) {
    if (parameter.advice.empty()) continue;
    const std::string line = fmt::format("{} is {}: {}", short_name(parameter.name),
                                         name_of(parameter.verdict), parameter.advice);
    if (!told.insert(line).second) continue;
    text += '\n';
    for (const std::string& part : wrapped(line, width)) text += part + '\n';
  }
  return text;
}

std::string belongs_to_text(const calibrate::Provenance& of, std::size_t width) {
  std::string stiffness;
  for (const auto& [experiment, factor] : of.stiffness_factor) {
    stiffness += fmt::format("{}{} {:g}", stiffness.empty() ? "" : ", ", experiment, factor);
  }
  const calibrate::ClumpFacts& clump = of.clump;
  const std::string text = fmt::format(
      "These coefficients belong to: {}, rolling friction {} ({}); a clump of {} ({}, "
      "volume {:+.2f} % off); stiffness factor {}; budget {}: {}.",
      of.contact_model, of.rolling_model, of.rolling_definition,
      clump.spheres == 1 ? "1 sphere" : fmt::format("{} spheres", clump.spheres), clump.source,
      100 * clump.volume_error, stiffness, of.study.budget, of.study.budget_description);
  std::string lines = "\n";
  for (const std::string& part : wrapped(text, width)) lines += part + '\n';
  return lines;
}

}  // namespace

std::string joint_table(const calibrate::JointResult& joint,
                        const calibrate::Provenance& provenance, int columns) {
  constexpr int kWidest = 100;
  const auto width = static_cast<std::size_t>(std::clamp(columns, 40, kWidest));
  return parameters_text(joint) + observables_text(joint) + family_text(joint) +
         advice_text(joint, width) + belongs_to_text(provenance, width);
}

}  // namespace repose::cli
