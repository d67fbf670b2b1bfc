#include "calibrate/result/summary_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace repose::calibrate {
namespace {

/// "23.4°", "9.54 mm"; "nothing" where there is no number.
std::string number_with_unit(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "nothing";
  if (unit == "deg") return fmt::format("{:.4g}°", value);
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ",
                     unit == "kg/m3" ? "kg/m³" : unit);
}

/// The sentence that a reader takes away; details are in prediction_text().
std::string headline_of(const Prediction& one) {
  const std::string margin = number_with_unit(one.tolerance, one.unit);
  const std::string possible = one.possible ? fmt::format(", where {:.3g} to {:.3g} was possible",
                                                          one.possible->low, one.possible->high)
                                            : "";
  const std::string text = fmt::format(
      "{} is predicted as {} (95 % interval {:.4g} to {:.4g}{}) and was measured as {}: ", one.name,
      number_with_unit(one.predicted, one.unit), one.interval.low, one.interval.high, possible,
      number_with_unit(one.measured, one.unit));
  switch (one.verdict) {
    case AgreementVerdict::agrees:
      return text + "agrees within " + margin;
    case AgreementVerdict::disagrees:
      return text + "disagrees";
    case AgreementVerdict::cannot_tell:
      break;
  }
  return text + "cannot tell, as neither agreement within " + margin + " nor a difference is shown";
}

/// Empty where nothing was held out.
std::string predictions_text(const JointResult& joint) {
  std::string text;
  for (const Prediction& one : joint.held_out) {
    text += (text.empty() ? "Held out of the fit: " : "; ") + headline_of(one);
  }
  return text.empty() ? text : text + '.';
}

std::string agreement_sentence(const JointResult& joint) {
  const bool is_doubtful = joint.verdict == AgreementVerdict::disagrees;
  return fmt::format("In simulations with fresh seeds, {}.{}", joint.agreement.text,
                     is_doubtful ? " Do not use these coefficients until you know why." : "");
}

std::string determined_sentence(const JointResult& joint) {
  const auto with = [&](Verdict verdict) {
    return std::ranges::count(joint.parameters, verdict, &ResultParameter::verdict);
  };
  const std::ptrdiff_t determined = with(Verdict::determined);
  const std::ptrdiff_t all = std::ssize(joint.parameters);
  if (determined == all) {
    return all == 1 ? "The coefficient is determined by these measurements."
                    : fmt::format("All {} coefficients are determined by these measurements.", all);
  }
  std::string text = determined == 0
                         ? "No coefficient is determined by these measurements."
                         : fmt::format("{} of {} coefficients {} determined by these measurements.",
                                       determined, all, determined == 1 ? "is" : "are");
  if (const auto bounded = with(Verdict::bounded); bounded > 0) {
    text += fmt::format(" {} {} bounded: known to an interval, not to a value.", bounded,
                        bounded == 1 ? "is" : "are");
  }
  if (const auto one_sided = with(Verdict::one_sided); one_sided > 0) {
    text += fmt::format(" For {}, only one end of the interval is determined.", one_sided);
  }
  if (const auto open = with(Verdict::undetermined); open > 0) {
    text += fmt::format(" {} {} undetermined", open, open == 1 ? "is" : "are");
    if (!joint.equivalence_family.empty()) {
      text += open == 1
                  ? ": these measurements hardly constrain it. Values of it that fit together "
                    "with those of the others are in the equally good sets"
                  : ": only certain combinations of them and of the others fit, such as the "
                    "equally good sets";
    }
    text += '.';
  }
  return text;
}

}  // namespace

std::vector<std::string> summary_sentences(const JointResult& joint) {
  std::vector<std::string> sentences = {predictions_text(joint), agreement_sentence(joint),
                                        determined_sentence(joint)};
  std::erase(sentences, "");
  return sentences;
}

bool has_open_coefficients(const JointResult& joint) {
  return std::ranges::any_of(joint.parameters, [](const ResultParameter& parameter) {
    return parameter.verdict != Verdict::determined;
  });
}

std::vector<EquivalentSet> good_sets(const JointResult& joint) {
  // The last check is of these values, or of the nearest that were simulated.
  EquivalentSet best;
  best.verdict = joint.verdict;
  for (const ResultParameter& parameter : joint.parameters) best.values.push_back(parameter.value);
  for (const ResultObservable& one : joint.observables) {
    best.simulated.push_back(one.verification.simulated);
  }
  std::vector<EquivalentSet> sets = {std::move(best)};
  sets.insert(sets.end(), joint.equivalence_family.begin(), joint.equivalence_family.end());
  return sets;
}

}  // namespace repose::calibrate
