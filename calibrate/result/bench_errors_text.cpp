#include "calibrate/result/bench_errors_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace repose::calibrate {

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

}  // namespace repose::calibrate
