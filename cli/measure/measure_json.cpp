#include "cli/measure/measure_json.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json degrees(const std::optional<double>& angle_rad) {
  return angle_rad ? Json(rounded_degrees(*angle_rad)) : Json(nullptr);
}

Json flank_json(const vision::Flank& flank) {
  Json windows = Json::array();
  for (const vision::WindowAngle& other : flank.other_windows) {
    windows.push_back({{"window", {other.window_from, other.window_to}},
                       {"angle_deg", rounded_degrees(other.angle_rad)}});
  }
  Json json{{"status", name_of(flank.status)},
            {"angle_deg", degrees(flank.angle_rad)},
            {"uncertainty_deg", degrees(flank.uncertainty_rad)},
            {"r2", number(flank.r2)},
            {"points", flank.points},
            {"least_squares_deg", degrees(flank.least_squares_rad)},
            {"robust_deg", degrees(flank.robust_rad)},
            {"bend_deg", degrees(flank.bend_rad)},
            {"other_windows", windows}};
  if (flank.status != vision::FlankStatus::ok) json["reason"] = flank.reason;
  return json;
}

Json warnings_json(const std::vector<vision::Warning>& warnings) {
  Json json = Json::array();
  for (const vision::Warning& warning : warnings) {
    json.push_back({{"code", warning.code}, {"message", warning.message}});
  }
  return json;
}

Json definitions_json(const std::vector<vision::NamedAngle>& definitions) {
  Json json = Json::array();
  for (const vision::NamedAngle& definition : definitions) {
    json.push_back({{"name", definition.name},
                    {"description", definition.description},
                    {"angle_deg", rounded_degrees(definition.angle_rad)}});
  }
  return json;
}

Json picture_json(const MeasuredPicture& picture) {
  const vision::ReposeAngle& angle = picture.angle;
  Json json{{"file", picture.file},
            {"status", name_of(angle.status)},
            {"angle_deg", degrees(angle.angle_rad)},
            {"uncertainty_deg", degrees(angle.uncertainty_rad)},
            {"left", flank_json(angle.left)},
            {"right", flank_json(angle.right)},
            {"ground_tilt_deg", degrees(angle.ground_tilt_rad)},
            {"window", angle.window},
            {"method", name_of(angle.method)},
            {"pitch_deg", degrees(angle.camera_pitch_rad)},
            {"confidence", angle.confidence},
            {"warnings", warnings_json(angle.warnings)},
            {"segmentation", angle.segmentation},
            {"strays", angle.strays},
            {"grain_px", number(angle.grain_px)},
            {"height_px", number(angle.height_px)},
            {"base_px", number(angle.base_px)},
            {"definitions", definitions_json(angle.definitions)}};
  if (picture.outcome != Outcome::measured) {
    json["reason"] = picture.error;
    for (const char* unknown : {"window", "method", "confidence", "segmentation", "strays"}) {
      json[unknown] = nullptr;
    }
  } else if (angle.status == vision::MeasureStatus::refused) {
    json["reason"] = angle.reason;
  }
  return json;
}

}  // namespace

std::string measure_json(const std::vector<MeasuredPicture>& pictures) {
  Json json = Json::array();
  for (const MeasuredPicture& picture : pictures) json.push_back(picture_json(picture));
  constexpr int kIndent = 2;
  // File names need not be UTF-8, JSON must be.
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
