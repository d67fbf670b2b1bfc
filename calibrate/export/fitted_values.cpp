#include "calibrate/export/export.h"
#include "calibrate/result/result.h"

namespace repose::calibrate {

std::vector<FittedValue> fitted_values(const StudyResult& result) {
  std::vector<FittedValue> values;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    for (const ResultParameter& parameter : joint->parameters) {
      values.push_back({.name = parameter.name,
                        .value = parameter.value,
                        .low = parameter.interval.low,
                        .high = parameter.interval.high,
                        .verdict = name_of(parameter.verdict)});
    }
    return values;
  }
  for (const auto& [name, value] : std::get<PublishedResult>(result.found).values) {
    values.push_back({.name = name, .value = value});
  }
  return values;
}

}  // namespace repose::calibrate
