#include "cli/compare/compare_json.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "calibrate/measured/json_text.h"
#include "cli/compare/compare_table.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

namespace {

/// The keys of a difference of angles, in comparisons of two pictures and of two sets.
inline void add_angle_difference(nlohmann::ordered_json& json,
                                 const std::optional<vision::AngleDifference>& angle) {
  using Json = nlohmann::ordered_json;
  json["angle_difference_deg"] =
      angle ? Json(rounded_degrees(angle->difference_rad)) : Json(nullptr);
  json["angle_difference_interval"] =
      angle
          ? Json({rounded_degrees(angle->interval_rad[0]), rounded_degrees(angle->interval_rad[1])})
          : Json(nullptr);
  json["verdict"] = name_of(angle ? angle->verdict : vision::Agreement::cannot_tell);
}

using Json = nlohmann::ordered_json;
using BothLengths = std::array<std::optional<double>, 2>;

/// BothLengths in the unit of the file: mm where the comparison has metres.
class LengthJson {
 public:
  explicit LengthJson(vision::LengthUnit unit) : per_unit_(shown_per_unit(unit)) {}

  Json operator()(const std::optional<double>& length) const {
    return length ? Json(*length * per_unit_) : Json(nullptr);
  }
  Json operator()(const BothLengths& lengths) const {
    return {(*this)(lengths[0]), (*this)(lengths[1])};
  }
  Json difference(const BothLengths& lengths) const {
    if (!lengths[0] || !lengths[1]) return nullptr;
    return (*lengths[0] - *lengths[1]) * per_unit_;
  }

 private:
  double per_unit_;
};

Json side_json(const vision::SideComparison& side, const LengthJson& length) {
  Json json{{"compared", name_of(side.cover)},
            {"iou", or_null(side.iou)},
            {"profile_rmse", length(side.profile_rmse)},
            {"profile_mean", length(side.profile_mean)},
            {"run_out", length(side.run_out)},
            {"run_out_difference", length.difference(side.run_out)}};
  add_angle_difference(json, side.angle);
  return json;
}

Json compare_warnings_json(const std::vector<vision::CompareWarning>& warnings) {
  Json json = Json::array();
  for (const vision::CompareWarning& warning : warnings) {
    json.push_back({{"picture", warning.picture ? Json(*warning.picture) : Json(nullptr)},
                    {"code", warning.warning.code},
                    {"message", warning.warning.message}});
  }
  return json;
}

Json in_grains(const ComparePlan& plan, const vision::HeapComparison& comparison) {
  if (!plan.grain_m || !comparison.profile_rmse || comparison.unit != vision::LengthUnit::metre) {
    return nullptr;
  }
  return *comparison.profile_rmse / *plan.grain_m;
}

/// The same of both.
Json definition_json(const ComparePlan& plan) {
  const std::string name = plan.measuring.front().named_definition();
  return name.empty() ? Json() : Json(name);
}

}  // namespace

std::string compare_json(const ComparePlan& plan, const vision::HeapComparison& comparison) {
  const LengthJson length(comparison.unit);
  const bool is_refused = comparison.status == vision::MeasureStatus::refused;
  Json json{{"files", {plan.sources[0].name, plan.sources[1].name}},
            {"status", name_of(comparison.status)},
            {"iou", or_null(comparison.iou)},
            {"profile_rmse", length(comparison.profile_rmse)},
            {"profile_mean", length(comparison.profile_mean)},
            {"profile_rmse_grains", in_grains(plan, comparison)},
            {"hausdorff", length(comparison.hausdorff)},
            {"hausdorff_95", length(comparison.hausdorff_95)},
            {"unit", is_refused ? Json(nullptr) : Json(name_of(comparison.unit))}};
  add_angle_difference(json, comparison.angle);
  json["margin_deg"] = degrees(plan.comparing.margin_rad);
  json["definition"] = definition_json(plan);
  json["angle_deg"] = {degrees(comparison.angle_rad[0]), degrees(comparison.angle_rad[1])};
  json["uncertainty_deg"] = {degrees(comparison.uncertainty_rad[0]),
                             degrees(comparison.uncertainty_rad[1])};
  json["left"] = side_json(comparison.left, length);
  json["right"] = side_json(comparison.right, length);
  json["height"] = length(comparison.height);
  json["height_difference"] = length.difference(comparison.height);
  json["base"] = length(comparison.base);
  json["base_difference"] = length.difference(comparison.base);
  json["aligned_by"] = is_refused                       ? Json(nullptr)
                       : comparison.is_aligned_by_crest ? Json("crest")
                                                        : Json("axis");
  json["best_shift"] = length(comparison.best_shift);
  json["best_shift_rmse"] = length(comparison.best_shift_rmse);
  json["warnings"] = compare_warnings_json(comparison.warnings);
  if (is_refused) json["reason"] = comparison.reason;
  constexpr int kNoteIndent = 2;
  // File names need not be UTF-8, JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

namespace {

using Json = nlohmann::ordered_json;

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

std::string sets_json(const ComparePlan& plan,
                      const std::array<std::vector<vision::SeenHeap>, 2>& heaps,
                      const vision::SetComparison& comparison) {
  const auto length = [&](const std::optional<double>& value) {
    return value ? Json(*value * shown_per_unit(comparison.unit)) : Json(nullptr);
  };
  Json json{{"sets", Json::array()}};
  for (const std::size_t i : {0, 1}) {
    json["sets"].push_back(set_json(plan.sources[i], heaps[i], comparison.sets[i]));
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
  // File names need not be UTF-8, JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
