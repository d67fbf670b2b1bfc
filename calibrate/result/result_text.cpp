#include "calibrate/result/result_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/distributions.h"

namespace repose::calibrate {

namespace {

constexpr double kShown = .05;  // a p-value below this shows a difference

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

/// "three", or "13".
std::string count_text(std::size_t count) {
  constexpr std::array<const char*, 11> kWords = {"none", "one",   "two",   "three", "four", "five",
                                                  "six",  "seven", "eight", "nine",  "ten"};
  return count < kWords.size() ? kWords.at(count) : fmt::format("{}", count);
}

/// "three of four experiments agree (tilt, roll, heap)"; empty if none does.
std::string agreeing_text(const Verification& verification) {
  const std::vector<const Agreement*> agreeing = with(verification, AgreementVerdict::agrees);
  const std::size_t all = verification.observables.size();
  if (agreeing.empty()) return {};
  const bool are_experiments = std::ranges::all_of(
      verification.observables,
      [](const Agreement& one) { return one.observable.find('.') == std::string::npos; });
  return fmt::format("{} of {} {}{} {} ({})", count_text(agreeing.size()), count_text(all),
                     are_experiments ? "experiment" : "measured quantit",
                     are_experiments ? (all == 1 ? "" : "s") : (all == 1 ? "y" : "ies"),
                     agreeing.size() == 1 ? "agrees" : "agree", names_of(agreeing));
}

/// Why neither agreement nor a difference is shown for an experiment.
std::string open_reason(const Agreement& agreement, bool is_one) {
  // A deterministic experiment has only one run.
  if (!std::isfinite(agreement.difference.low)) {
    return fmt::format("too few of {} runs gave a reading", is_one ? "its" : "their");
  }
  if (agreement.difference.low >= -agreement.tolerance &&
      agreement.difference.high <= agreement.tolerance) {
    return fmt::format("some of {} runs gave no reading", is_one ? "its" : "their");
  }
  if (agreement.runs_to_decide) {
    return fmt::format("{} {} simulated too few times", is_one ? "it" : "they",
                       is_one ? "was" : "were");
  }
  return fmt::format("{0} readings scatter too much for {0} margin", is_one ? "its" : "their");
}

/// "the drop is inconclusive: its readings scatter too much for its margin", for all inconclusive
/// ones.
std::string inconclusive_text(const Verification& verification) {
  std::vector<const Agreement*> left = with(verification, AgreementVerdict::cannot_tell);
  std::string text;
  while (!left.empty()) {
    const std::string reason = open_reason(*left.front(), true);
    std::vector<const Agreement*> alike;
    std::erase_if(left, [&](const Agreement* one) {
      const bool is_alike = open_reason(*one, true) == reason;
      if (is_alike) alike.push_back(one);
      return is_alike;
    });
    const bool is_one = alike.size() == 1;
    text +=
        fmt::format("{}{}{} {} inconclusive: {}", text.empty() ? "" : "; ", is_one ? "the " : "",
                    names_of(alike), is_one ? "is" : "are", open_reason(*alike.front(), is_one));
  }
  return text;
}

/// The text on what agrees, followed by `rest`.
std::string after_what_agrees(const Verification& verification, const std::string& rest) {
  const std::string agreeing = agreeing_text(verification);
  return agreeing.empty() ? rest : agreeing + "; " + rest;
}

/// In case of agreement: a difference may be too small to matter but still significant.
std::string shown_difference(const Verification& verification) {
  if (!(verification.chance < kShown)) return {};
  return fmt::format(
      "; what they differ by is too small to matter by these margins, and still more than chance "
      "makes (as large differences arise by chance in {} of cases)",
      percent(verification.chance));
}

/// What would decide it.
std::string way_out(const Agreement& agreement) {
  if (agreement.runs < 2 && !std::isfinite(agreement.difference.low)) {
    return "too few of its runs gave a reading";
  }
  if (agreement.runs_to_decide) {
    return fmt::format("about {} runs would decide, {} were made", *agreement.runs_to_decide,
                       agreement.runs);
  }
  if (agreement.readings_to_decide) {
    return fmt::format("more runs would not decide, about {} bench readings would",
                       *agreement.readings_to_decide);
  }
  return "neither more runs nor more bench readings alone would decide: take more of both, or "
         "state "
         "a wider tolerance where that is what you need";
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
  const std::string source = margin_text(agreement.tolerance_from);
  const std::string from = source.empty() ? "" : fmt::format(" ({})", source);
  if (agreement.runs == 0) return "no run gave a reading";
  if (agreement.verdict == AgreementVerdict::agrees) {
    return fmt::format("within {:.3g}{} of each other{}", agreement.tolerance, in_unit, from);
  }
  if (agreement.verdict == AgreementVerdict::disagrees) {
    return fmt::format("so large a difference arises by chance in {} of cases",
                       percent(agreement.chance));
  }
  const std::string margin = fmt::format("margin {:.3g}{}{}", agreement.tolerance, in_unit, from);
  if (!std::isfinite(agreement.difference.low)) return margin + "; " + way_out(agreement);
  if (!std::isfinite(agreement.detectable)) {
    return fmt::format("the fit follows this reading, no difference could be seen; {}; {}", margin,
                       way_out(agreement));
  }
  return fmt::format("detectable difference {:.3g}{}, {}; {}", agreement.detectable, in_unit,
                     margin, way_out(agreement));
}

std::string bounds_text(const ResultParameter& parameter) {
  if (parameter.verdict != Verdict::one_sided && parameter.verdict != Verdict::undetermined) {
    return {};
  }
  const Interval& bounds = parameter.bounds;
  const double middle = (bounds.low + bounds.high) / 2;
  const bool is_high = parameter.interval.high - middle > middle - parameter.interval.low;
  const std::string where =
      parameter.verdict == Verdict::one_sided
          ? fmt::format("its interval ends at the bound {:.4g}", is_high ? bounds.high : bounds.low)
          : "its interval is about that of its bounds";
  if (!parameter.bounds_are) {
    return where +
           ", and the study does not say whether its bounds are known or convenience (bounds = "
           "...)";
  }
  return where + (*parameter.bounds_are == BoundsOrigin::known
                      ? ", which is known beforehand by the study"
                      : ", which the study calls convenience: beyond it values may fit as well");
}

std::string margin_text(const std::optional<MarginSource>& source) {
  if (!source) return {};
  switch (*source) {
    case MarginSource::study:
      return "stated in the study";
    case MarginSource::reading:
      return "10 % of the reading";
    case MarginSource::range:
      return "10 % of the range of readings that the bounds allow";
    case MarginSource::angle:
      break;
  }
  return "that of angles";
}

std::string prediction_text(const Prediction& prediction) {
  const std::string unit = prediction.unit.empty() ? "" : ' ' + prediction.unit;
  std::string text =
      fmt::format("{}: predicted {:.3g} ± {:.2g}{} (95 %)", prediction.name, prediction.predicted,
                  (prediction.interval.high - prediction.interval.low) / 2, unit);
  if (prediction.possible) {
    const Interval& possible = *prediction.possible;
    text += fmt::format(", where {:.3g} to {:.3g} was possible within the bounds", possible.low,
                        possible.high);
    if (2 * prediction.tolerance >= possible.high - possible.low) {
      text += ": no more than its margin allows, so that agreement would be no test";
    }
  }
  text += fmt::format("; margin {:.3g}{}", prediction.tolerance, unit);
  if (prediction.tolerance_from)
    text += fmt::format(", {}", margin_text(prediction.tolerance_from));
  if (prediction.readings_to_decide) {
    text += fmt::format("; about {} bench readings would decide", *prediction.readings_to_decide);
  }
  return text;
}

std::string freedom_text(const JointResult& joint) {
  if (!joint.degrees_of_freedom) return {};
  return fmt::format(
      "chi-square {:.3g} of {:.1f} degrees of freedom: readings less what the coefficients use up",
      joint.chi2, *joint.degrees_of_freedom);
}

std::string agreement_text(const Verification& verification, double degrees) {
  const bool is_tested = degrees >= 1;
  switch (verification.verdict) {
    case AgreementVerdict::agrees:
      if (is_tested) {
        return "bench and simulation agree: every experiment is shown to be within its margin" +
               shown_difference(verification);
      }
      return fmt::format(
          "the bench is reproduced, not tested: every experiment is shown to be within its margin, "
          "but the coefficients use up what these experiments tell ({:.1f} degrees of freedom are "
          "left), so that a wrong model would be followed as well. A reading that is held out "
          "would test it",
          degrees);
    case AgreementVerdict::disagrees:
      return after_what_agrees(verification, disagreement(verification));
    case AgreementVerdict::cannot_tell:
      break;
  }
  return after_what_agrees(
      verification,
      fmt::format(
          "{}; no difference is shown (as large ones arise by chance in {} of cases){}",
          inconclusive_text(verification), percent(verification.chance),
          is_tested ? ""
                    : fmt::format(". Nor would agreement be more than reproduced, not tested: the "
                                  "coefficients use up what these experiments tell ({:.1f} "
                                  "degrees of freedom are left)",
                                  degrees)));
}

std::string shape_check_text(const ShapeCheck& shape) {
  if (!shape.not_made.empty()) {
    return fmt::format("What more spheres change was not checked: {}.",
                       shape.not_made.substr(0, shape.not_made.find_last_not_of(". ") + 1));
  }
  if (shape.over_budget.empty()) return {};
  return fmt::format(
      "What more spheres than {} change was not checked for {}: it would take more than a fifth of "
      "this budget.",
      shape.spheres, fmt::join(shape.over_budget, ", "));
}

std::string systematic_text(const ResultObservable& observable) {
  if (!(observable.systematic_uncertainty > 0)) return {};
  std::string parts;
  for (const auto& [name, sd] : observable.systematic) {
    parts += fmt::format("{}{} {:.2g}", parts.empty() ? "" : ", ", name, sd);
  }
  return fmt::format("± {:.2g}{}{}{}, which more readings do not lower",
                     observable.systematic_uncertainty, observable.unit.empty() ? "" : " ",
                     observable.unit, parts.empty() ? "" : " (" + parts + ")");
}

std::string model_error_text(const JointResult& joint) {
  std::string sds;
  for (const ResultObservable& observable : joint.observables) {
    if (!(observable.model_uncertainty > 0)) continue;
    sds += fmt::format("{}{} {:.2g}{}{}", sds.empty() ? "" : ", ", observable.name,
                       observable.model_uncertainty, observable.unit.empty() ? "" : " ",
                       observable.unit);
  }
  if (sds.empty()) return {};
  const double scale = joint.model_error_scale.value_or(1);
  return fmt::format(
      "whatever its coefficients, the model is taken to miss {} (standard deviation){}", sds,
      scale > 1 ? fmt::format(": {:.2g} times what the study says or is usual, as "
                              "the readings contradict each other by more than "
                              "chance and that",
                              scale)
                : "");
}

std::string coarse_text(const JointResult& joint) {
  std::string text;
  for (std::size_t k = 0; k < joint.surrogates.size(); ++k) {
    const SurrogateQuality& surrogate = joint.surrogates[k];
    const bool is_own = surrogate.full_size == 1;
    const std::string full =
        is_own ? "the study's" : fmt::format("those {:.3g} times as large", surrogate.full_size);
    // Once for each experiment: the value's comes first.
    if (!is_own && surrogate.observable.find('.') == std::string::npos) {
      text += fmt::format(
          "{}no run of {} had the study's own grains, which would take longer than the budget "
          "allows: full runs and checks were of grains {:.3g} times as large, and what that may "
          "change is part of the model's error",
          text.empty() ? "" : "; ", surrogate.observable, surrogate.full_size);
    }
    if (!surrogate.coarse) continue;
    const CoarseQuality& coarse = *surrogate.coarse;
    const std::string& unit = joint.observables[k].unit;
    text += fmt::format(
        "{}{} of {} runs of {} were of grains {:.3g} times as large, which are taken to read "
        "{:+.2g} ± {:.2g}{}{} beside {} (95 %) and scatter {:.2g} times as much",
        text.empty() ? "" : "; ", coarse.runs, surrogate.runs, surrogate.observable, coarse.size,
        coarse.shift, base::kNormal95 * coarse.uncertainty, unit.empty() ? "" : " ", unit, full,
        coarse.scatter);
    if (surrogate.full_runs() == 0) {
      text += fmt::format(", which is assumed: none of {} has given a reading",
                          is_own ? "the study's own" : "these");
    }
    if (coarse.failed_runs > 0) {
      text += fmt::format("; {} more of these gave no reading", coarse.failed_runs);
    }
  }
  return text;
}

std::string larger_grains_text(const std::vector<SensitivityCheck>& checks) {
  std::string names;
  double size = 1;
  for (const SensitivityCheck& check : checks) {
    if (check.grain_size == 1) continue;
    names += (names.empty() ? "" : ", ") + check.name;
    size = check.grain_size;
  }
  if (names.empty()) return {};
  return fmt::format(
      "{}: compared in grains {:.3g} times as large, which are taken to change by as "
      "much as the study's",
      names, size);
}

std::string condition_text(const JointResult& joint, const ResultParameter& parameter) {
  const AssumedScatters& assumed = joint.assumed_scatters;
  const auto found =
      std::ranges::find(assumed.coefficients, parameter.name, &ScatterDependence::name);
  if (found == assumed.coefficients.end() || found->rests_on.empty()) return {};
  if (parameter.verdict == Verdict::undetermined) return {};
  std::string text;
  for (const AssumedScatter& reading : assumed.readings) {
    if (std::ranges::find(found->rests_on, reading.observable) == found->rests_on.end()) continue;
    text += text.empty()
                ? fmt::format("if single readings of {} scatter by {:.2g} %", reading.observable,
                              100 * reading.fraction)
                : fmt::format(", of {} by {:.2g} %", reading.observable, 100 * reading.fraction);
  }
  return text;
}

namespace {

/// "23.4°", "9.54 mm"; "nothing" if there is no number.
std::string number_with_unit(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "nothing";
  if (unit == "deg") return fmt::format("{:.4g}°", value);
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ",
                     unit == "kg/m3" ? "kg/m³" : unit);
}

/// The main message; details are in prediction_text().
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

/// Empty if nothing was held out.
std::string predictions_text(const JointResult& joint) {
  std::string text;
  for (const Prediction& one : joint.held_out) {
    text += (text.empty() ? "Held out of the fit: " : "; ") + headline_of(one);
  }
  return text.empty() ? text : text + '.';
}

std::string agreement_sentence(const JointResult& joint) {
  if (!joint.verdict) return fmt::format("Not checked in simulations: {}.", joint.agreement.text);
  const bool is_doubtful = joint.verdict == AgreementVerdict::disagrees;
  return fmt::format("In {} with fresh seeds, {}.{}",
                     joint.is_of_table ? "runs at these values" : "simulations",
                     joint.agreement.text,
                     is_doubtful ? " Do not use these coefficients until you know why." : "");
}

/// Empty for a final result.
std::string provisional_sentence(const JointResult& joint) {
  if (joint.provisional.empty()) return {};
  return fmt::format(
      "PROVISIONAL, no final result: {}. Values, intervals and verdicts are those known so far, "
      "and "
      "may change. The same repose calibrate command goes on from here.",
      joint.provisional);
}

std::string determined_sentence(const JointResult& joint) {
  const auto with = [&](Verdict verdict) {
    return std::ranges::count(joint.parameters, verdict, &ResultParameter::verdict);
  };
  const std::ptrdiff_t determined = with(Verdict::determined);
  const std::ptrdiff_t all = std::ssize(joint.parameters);
  if (determined == all) {
    if (all == 1) return "The coefficient is determined by these measurements.";
    return fmt::format("{} coefficients are determined by these measurements.",
                       all == 2 ? std::string("Both") : fmt::format("All {}", all));
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
  std::vector<std::string> sentences = {provisional_sentence(joint), predictions_text(joint),
                                        agreement_sentence(joint), determined_sentence(joint)};
  std::erase(sentences, "");
  return sentences;
}

bool has_open_coefficients(const JointResult& joint) {
  return std::ranges::any_of(joint.parameters, [](const ResultParameter& parameter) {
    return parameter.verdict != Verdict::determined;
  });
}

std::vector<EquivalentSet> good_sets(const JointResult& joint) {
  // The last check used these values, or the nearest simulated ones.
  EquivalentSet best;
  best.verdict = joint.verdict;
  for (const ResultParameter& parameter : joint.parameters) best.values.push_back(parameter.value);
  for (const ResultObservable& one : joint.observables) {
    if (one.verification) best.simulated.push_back(one.verification->simulated);
  }
  std::vector<EquivalentSet> sets = {std::move(best)};
  sets.insert(sets.end(), joint.equivalence_family.begin(), joint.equivalence_family.end());
  return sets;
}

}  // namespace repose::calibrate
