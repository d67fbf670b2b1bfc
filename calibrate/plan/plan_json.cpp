#include <nlohmann/json.hpp>

#include "calibrate/plan/plan.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::ordered_json;

Json by_parameter(const Plan& plan, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k) json[plan.parameters[k]] = values[k];
  return json;
}

void add(const Plan& plan, const Outlook& outlook, Json& json) {
  json["interval_widths"] = by_parameter(plan, outlook.widths);
  json["determined"] = by_parameter(plan, outlook.determined);
}

Json prospect_json(const Plan& plan, const Prospect& prospect) {
  const auto run_s = plan.run_s.find(prospect.experiment);
  return {{"experiment", prospect.experiment},
          {"measured", prospect.is_measured},
          {"runs", prospect.runs},
          {"failed_runs", prospect.failed_runs},
          {"run_s", run_s == plan.run_s.end() ? Json(nullptr) : Json(run_s->second)},
          {"effects", prospect.is_known ? by_parameter(plan, prospect.effects) : Json(nullptr)}};
}

}  // namespace

std::string plan_json(const Plan& plan, const OfferedStudy& offered) {
  Json json = {{"study", offered.study.file.filename().string()},
               {"hash", offered.study.hash},
               {"readings", plan.readings},
               {"experiments", Json::array()},
               {"now", Json::object()},
               {"steps", Json::array()},
               {"notes", plan.notes}};
  for (const Prospect& prospect : plan.prospects) {
    json["experiments"].push_back(prospect_json(plan, prospect));
  }
  add(plan, plan.now, json["now"]);
  for (const PlannedStep& step : plan.steps) {
    Json& added = json["steps"].emplace_back(
        Json{{"experiment", plan.prospects[step.experiment].experiment}});
    add(plan, step.outlook, added);
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::calibrate
