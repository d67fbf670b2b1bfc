#include <nlohmann/json.hpp>

#include "cli/camera/camera_result.h"
#include "cli/common/degrees.h"
#include "cli/common/shared_json.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;
using vision::Lens;
using vision::LensNumber;
using vision::MeasureStatus;

Json calibrated_picture_json(const CameraResult& result, std::size_t place) {
  const vision::FittedPicture& picture = result.fit.pictures[place];
  return {{"file", result.files[place]},
          {"corners", picture.corners},
          {"used", picture.is_used},
          {"error_px", or_null(picture.error_px)},
          {"turned_deg", picture.tilt_rad ? Json(rounded_degrees(*picture.tilt_rad)) : Json()},
          {"distance_mm", picture.distance ? Json(*picture.distance * result.square_mm) : Json()}};
}

void add(Json& json, const char* key, const char* uncertainty_key, const LensNumber& of,
         bool exists) {
  json[key] = exists ? Json(of.value) : Json();
  json[uncertainty_key] = exists ? Json(of.uncertainty) : Json();
}

}  // namespace

std::string camera_json(const CameraResult& result) {
  const vision::LensFit& fit = result.fit;
  const Lens& lens = fit.lens;
  const bool exists = fit.status != MeasureStatus::refused;
  Json json{{"status", name_of(fit.status)},
            {"width_px", exists ? Json(lens.width) : Json()},
            {"height_px", exists ? Json(lens.height) : Json()}};
  add(json, "focal_px", "focal_uncertainty_px", lens.focal_px, exists);
  add(json, "centre_x_px", "centre_x_uncertainty_px", lens.centre_x_px, exists);
  add(json, "centre_y_px", "centre_y_uncertainty_px", lens.centre_y_px, exists);
  add(json, "k1", "k1_uncertainty", lens.k1, exists);
  add(json, "k2", "k2_uncertainty", lens.k2, exists);
  add(json, "p1", "p1_uncertainty", lens.p1, exists);
  add(json, "p2", "p2_uncertainty", lens.p2, exists);
  add(json, "k3", "k3_uncertainty", lens.k3, exists);
  json["error_px"] = or_null(fit.error_px);
  json["coverage"] = or_null(fit.coverage);
  json["square_mm"] = result.square_mm;
  json["pictures"] = Json::array();
  for (std::size_t i = 0; i < result.files.size(); ++i) {
    json["pictures"].push_back(calibrated_picture_json(result, i));
  }
  json["warnings"] = Json::array();
  for (const vision::Warning& warning : fit.warnings) {
    json["warnings"].push_back({{"code", warning.code}, {"message", warning.message}});
  }
  if (!exists) json["reason"] = fit.reason;
  // File names need not be UTF-8, JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
