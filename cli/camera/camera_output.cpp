#include "cli/camera/camera_output.h"

#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/measured/json_text.h"
#include "cli/common/table.h"
#include "vision/measure/repose_angle.h"

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
  // File names need not be UTF-8, but JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

namespace {

using vision::LensNumber;
using vision::MeasureStatus;

std::string number_cell(const std::optional<double>& value, double unit, int digits) {
  return value ? fmt::format("{:.{}f}", *value * unit, digits) : kMissing;
}

std::string pictures_table(const CameraResult& result, int terminal_columns) {
  Table table({{.heading = "picture"},
               number_column("corners"),
               number_column("error [px]"),
               number_column("turned [°]"),
               number_column("distance [mm]"),
               {.heading = "used"}});
  for (std::size_t i = 0; i < result.files.size(); ++i) {
    const vision::FittedPicture& picture = result.fit.pictures[i];
    table.add_row({result.files[i], fmt::format("{}", picture.corners),
                   number_cell(picture.error_px, 1, 2),
                   number_cell(picture.tilt_rad, to_degrees(1), 0),
                   number_cell(picture.distance, result.square_mm, 0),
                   picture.is_used ? "yes" : "no: too little of the board is seen"});
  }
  return table.text(terminal_columns);
}

std::string lens_table(const CameraResult& result, int terminal_columns) {
  const vision::Lens& lens = result.fit.lens;
  Table table({{.heading = "lens"}, number_column("value"), number_column("± (95 %)")});
  const auto add = [&](const char* name, const LensNumber& number, int digits) {
    table.add_row({name, fmt::format("{:.{}f}", number.value, digits),
                   fmt::format("{:.{}f}", number.uncertainty, digits)});
  };
  add("focal length [px]", lens.focal_px, 1);
  add("centre, from the left [px]", lens.centre_x_px, 1);
  add("centre, from the top [px]", lens.centre_y_px, 1);
  constexpr int kDigits = 4;
  const std::pair<const char*, const LensNumber*> coefficients[] = {
      {"k1", &lens.k1}, {"k2", &lens.k2}, {"p1", &lens.p1}, {"p2", &lens.p2}, {"k3", &lens.k3}};
  for (const auto& [name, number] : coefficients) {
    if (number->value != 0) add(name, *number, kDigits);
  }
  if (!lens.is_distorted()) table.add_note("  ", "no distortion can be seen");
  table.add_note("  ",
                 fmt::format("corners lie {:.2f} px from the fit; the boards cover {:.0f} % of "
                             "the picture",
                             *result.fit.error_px, 100 * *result.fit.coverage));
  for (const vision::Warning& warning : result.fit.warnings) {
    table.add_note("  ! ", warning.message);
  }
  return table.text(terminal_columns);
}

}  // namespace

std::string origin_of(const CameraResult& result) {
  int used = 0;
  for (const vision::FittedPicture& picture : result.fit.pictures) used += picture.is_used ? 1 : 0;
  return fmt::format("{} pictures, corners {:.2f} px from the fit, {:.0f} % of the picture covered",
                     used, *result.fit.error_px, 100 * *result.fit.coverage);
}

std::string camera_table(const CameraResult& result, int terminal_columns) {
  std::string text = pictures_table(result, terminal_columns) + '\n';
  if (result.fit.status != MeasureStatus::refused) {
    return text + lens_table(result, terminal_columns);
  }
  std::istringstream reasons(result.fit.reason);
  for (std::string reason; std::getline(reasons, reason);) {
    text += paragraph("refused: ", reason, terminal_columns);
  }
  return text;
}

}  // namespace repose::cli
