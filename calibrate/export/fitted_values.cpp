#include <utility>

#include "calibrate/export/export.h"
#include "calibrate/result/result.h"
#include "calibrate/result/summary_text.h"

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

std::vector<std::vector<double>> exported_sets(const StudyResult& result) {
  std::vector<std::vector<double>> sets;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    for (EquivalentSet& set : good_sets(*joint)) sets.push_back(std::move(set.values));
    return sets;
  }
  sets.emplace_back();
  for (const auto& [name, value] : std::get<PublishedResult>(result.found).values) {
    sets.back().push_back(value);
  }
  return sets;
}

}  // namespace repose::calibrate
