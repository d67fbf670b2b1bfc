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
