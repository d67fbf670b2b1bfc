#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/export/export.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::json;

FittedValue fitted_value(const Json& parameter) {
  FittedValue fitted{.name = parameter.at("name"), .value = parameter.at("value")};
  fitted.verdict = parameter.value("verdict", "");
  const Json interval = parameter.value("interval", Json::array());
  if (interval.size() == 2 && interval[0].is_number() && interval[1].is_number()) {
    fitted.low = interval[0];
    fitted.high = interval[1];
  }
  return fitted;
}

std::vector<FittedValue> fitted_values(const Json& result) {
  std::vector<FittedValue> all;
  if (result.contains("parameters")) {
    for (const Json& parameter : result.at("parameters")) all.push_back(fitted_value(parameter));
  } else {  // of --method paper: single points without intervals
    for (const auto& [name, value] : result.at("values").items()) {
      all.push_back({.name = name, .value = value});
    }
  }
  return all;
}

}  // namespace

std::vector<FittedValue> parse_fitted_values(const std::string& json, const std::string& name) {
  try {
    return fitted_values(Json::parse(json));
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format(
        "{}: is no result of repose calibrate ({}). Fix: repose calibrate STUDY.toml --out with "
        "the same folder writes it anew.",
        name, error.what()));
  }
}

}  // namespace repose::calibrate
