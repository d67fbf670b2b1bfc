#include "calibrate/compared/compared_json.h"

#include <utility>
#include <vector>

#include "calibrate/measured/json_text.h"

namespace repose::calibrate {

using Json = nlohmann::ordered_json;

void add_angle_difference(nlohmann::ordered_json& json,
                          const std::optional<vision::AngleDifference>& angle) {
  json["angle_difference_deg"] =
      angle ? Json(rounded_degrees(angle->difference_rad)) : Json(nullptr);
  json["angle_difference_interval"] =
      angle
          ? Json({rounded_degrees(angle->interval_rad[0]), rounded_degrees(angle->interval_rad[1])})
          : Json(nullptr);
  json["verdict"] = name_of(angle ? angle->verdict : vision::Agreement::cannot_tell);
}

Json definition_json(const SetsPlan& plan) {
  const std::string name = plan.measuring.front().named_definition();
  return name.empty() ? Json() : Json(name);
}

namespace {

Json heaps_json(const HeapSource& source, const std::vector<vision::SeenHeap>& heaps,
                const vision::SetOfHeaps& set) {
  Json json = Json::array();
  for (std::size_t i = 0; i < heaps.size(); ++i) {
    Json files = Json::array();
    for (const auto& file : source.files_of_heap(i)) files.push_back(file.string());
    Json statuses = Json::array();
    for (const vision::ReposeAngle& view : heaps[i].views) statuses.push_back(name_of(view.status));
    json.push_back({{"file", files.front()},
                    {"files", files},
                    {"angle_deg", degrees(set.angle_rad[i])},
                    {"pictures", std::move(statuses)}});
  }
  return json;
}

Json set_json(const HeapSource& source, const std::vector<vision::SeenHeap>& heaps,
              const vision::SetOfHeaps& set) {
  Json interval = nullptr;
  if (set.uncertainty_rad) {
    interval = {rounded_degrees(*set.mean_rad - *set.uncertainty_rad),
                rounded_degrees(*set.mean_rad + *set.uncertainty_rad)};
  }
  return {{"name", source.name},
          {"n", set.counted},
          {"mean_deg", degrees(set.mean_rad)},
          {"sd_deg", degrees(set.sd_rad)},
          {"interval_deg", std::move(interval)},
          {"heaps", heaps_json(source, heaps, set)}};
}

}  // namespace

std::string sets_json(const ComparedSets& compared) {
  const SetsPlan& plan = compared.plan;
  const vision::SetComparison& comparison = compared.comparison;
  const auto length = [&](const std::optional<double>& value) {
    return value ? Json(*value * shown_per_unit(comparison.unit)) : Json(nullptr);
  };
  Json json{{"sets", Json::array()}};
  for (const std::size_t i : {0, 1}) {
    json["sets"].push_back(set_json(plan.sources[i], compared.heaps[i], comparison.sets[i]));
  }
  json["camera_mm"] = nullptr;
  if (plan.camera) {
    json["camera_mm"] = {1000 * plan.camera->distance_m, 1000 * plan.camera->height_m};
  }
  json["iou"] = comparison.iou ? Json(*comparison.iou) : Json(nullptr);
  json["profile_rmse"] = length(comparison.profile_rmse);
  json["profile_mean"] = length(comparison.profile_mean);
  json["unit"] = comparison.iou ? Json(name_of(comparison.unit)) : Json(nullptr);
  add_angle_difference(json, comparison.angle);
  json["margin_deg"] = degrees(plan.comparing.margin_rad);
  json["definition"] = definition_json(plan);
  json["heaps_to_tell"] =
      comparison.heaps_to_tell ? Json(*comparison.heaps_to_tell) : Json(nullptr);
  json["warnings"] = Json::array();
  for (const vision::Warning& warning : comparison.warnings) {
    json["warnings"].push_back({{"code", warning.code}, {"message", warning.message}});
  }
  constexpr int kNoteIndent = 2;
  // File names need not be UTF-8, but JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::calibrate
