#include "cli/compare/compare_json.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "calibrate/compared/compared_json.h"
#include "calibrate/measured/json_text.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

namespace {

using calibrate::add_angle_difference;
using calibrate::definition_json;
using calibrate::name_of;
using calibrate::shown_per_unit;
using vision::name_of;

using Json = nlohmann::ordered_json;
using BothLengths = std::array<std::optional<double>, 2>;

/// BothLengths in the unit of the file: mm if the comparison is in metres.
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
  // File names need not be UTF-8, but JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
