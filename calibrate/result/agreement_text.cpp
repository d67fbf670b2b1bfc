#include "calibrate/result/agreement_text.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace repose::calibrate {
namespace {

std::vector<const Agreement*> with(const Verification& verification, AgreementVerdict verdict) {
  std::vector<const Agreement*> found;
  for (const Agreement& agreement : verification.observables) {
    if (agreement.verdict == verdict) found.push_back(&agreement);
  }
  return found;
}

std::string names_of(const std::vector<const Agreement*>& agreements) {
  std::string names;
  for (const Agreement* agreement : agreements) {
    names += (names.empty() ? "" : ", ") + agreement->observable;
  }
  return names;
}

std::string percent(double chance) {
  if (chance < 1e-4) return "less than 0.01 %";
  return chance < .1 ? fmt::format("{:.2g} %", 100 * chance)
                     : fmt::format("{:.0f} %", 100 * chance);
}

/// What would decide it.
std::string way_out(const Agreement& agreement) {
  if (agreement.runs < 2 && !std::isfinite(agreement.detectable)) {
    return "too few of its runs gave a reading";
  }
  if (agreement.runs_to_decide) {
    return fmt::format("about {} runs would decide, {} were made", *agreement.runs_to_decide,
                       agreement.runs);
  }
  const bool is_off = std::abs(agreement.simulated - agreement.measured) >= agreement.tolerance;
  return is_off
             ? "more runs would not decide: take more bench readings"
             : "more runs would hardly help: take more bench readings, or state a wider tolerance";
}

std::string disagreement(const Verification& verification) {
  std::vector<const Agreement*> differing = with(verification, AgreementVerdict::disagrees);
  std::vector<const Agreement*> silent;
  for (const Agreement* agreement : differing) {
    if (agreement->runs == 0) silent.push_back(agreement);
  }
  std::erase_if(differing, [](const Agreement* agreement) { return agreement->runs == 0; });
  if (!silent.empty() && differing.empty()) {
    return "bench and simulation disagree: no run gave a reading of " + names_of(silent);
  }
  std::string text = fmt::format(
      "bench and simulation disagree: differences as large as all of these together arise by "
      "chance "
      "in {} of cases",
      percent(verification.chance));
  if (differing.empty()) return text + "; no single experiment shows it by itself";
  text += fmt::format("; it is {} that {}", names_of(differing),
                      differing.size() == 1 ? "differs" : "differ");
  return silent.empty() ? text : text + "; no run gave a reading of " + names_of(silent);
}

}  // namespace

std::string agreement_text(const Agreement& agreement, const std::string& unit) {
  const std::string in_unit = unit.empty() ? "" : ' ' + unit;
  if (agreement.runs == 0) return "no run gave a reading";
  if (agreement.verdict == AgreementVerdict::agrees) {
    return fmt::format("within {:.3g}{} of each other", agreement.tolerance, in_unit);
  }
  if (agreement.verdict == AgreementVerdict::disagrees) {
    return fmt::format("so large a difference arises by chance in {} of cases",
                       percent(agreement.chance));
  }
  if (!std::isfinite(agreement.detectable)) return way_out(agreement);
  return fmt::format("detectable difference {:.3g}{}, tolerance {:.3g}{}; {}", agreement.detectable,
                     in_unit, agreement.tolerance, in_unit, way_out(agreement));
}

std::string agreement_text(const Verification& verification) {
  switch (verification.verdict) {
    case AgreementVerdict::agrees:
      return "bench and simulation agree: every experiment is shown to be within its tolerance";
    case AgreementVerdict::disagrees:
      return disagreement(verification);
    case AgreementVerdict::cannot_tell:
      break;
  }
  return fmt::format(
      "it cannot be told whether bench and simulation agree: no difference is shown (as large ones "
      "arise by chance in {} of cases), but neither is agreement within the tolerance for {}",
      percent(verification.chance), names_of(with(verification, AgreementVerdict::cannot_tell)));
}

std::string shape_check_text(const ShapeCheck& shape) {
  if (!shape.not_made.empty()) {
    return fmt::format("What more spheres change was not checked: {}.",
                       shape.not_made.substr(0, shape.not_made.find_last_not_of(". ") + 1));
  }
  if (shape.too_dear.empty()) return {};
  return fmt::format(
      "What more spheres than {} change was not checked for {}: it would take more than a fifth of "
      "this budget.",
      shape.spheres, fmt::join(shape.too_dear, ", "));
}

}  // namespace repose::calibrate
