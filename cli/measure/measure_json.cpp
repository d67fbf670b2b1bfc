#include "cli/measure/measure_json.h"

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"
#include "cli/common/json_text.h"
#include "cli/common/shared_json.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A length and its half-width, null where there is none.
void add_estimate(Json& json, const std::string& key,
                  const std::optional<vision::Estimate>& estimate) {
  json[key] = estimate ? Json(estimate->value) : Json();
  json[key + "_uncertainty"] = estimate ? Json(estimate->uncertainty) : Json();
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
            {"r2", or_null(flank.r2)},
            {"points", flank.points},
            {"window_used", flank.window_used ? Json(*flank.window_used) : Json()},
            {"least_squares_deg", degrees(flank.least_squares_rad)},
            {"robust_deg", degrees(flank.robust_rad)},
            {"bend_deg", degrees(flank.bend_rad)},
            {"other_windows", windows}};
  if (flank.status != vision::FlankStatus::ok) json["reason"] = flank.reason;
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

Json box_json(const std::optional<vision::Box>& box) {
  if (!box) return nullptr;
  return Json::array({box->x, box->y, box->width, box->height});
}

Json line_json(const std::optional<vision::Segment>& line) {
  if (!line) return nullptr;
  return Json::array({line->from.x, line->from.y, line->to.x, line->to.y});
}

/// What a person has said of the picture; null when nothing.
Json hints_json(const vision::Hints& hints) {
  if (hints.empty() && hints.source.empty()) return nullptr;
  return {{"heap", box_json(hints.heap)},
          {"ground", line_json(hints.ground)},
          {"keep", places_json(hints.keep)},
          {"drop", places_json(hints.drop)},
          {"mask", hints.mask.width > 0},
          {"file", hints.source.empty() ? Json() : Json(hints.source)}};
}

Json excluded_json(const std::vector<vision::Box>& boxes) {
  Json json = Json::array();
  for (const vision::Box& box : boxes) json.push_back(box_json(box));
  return json;
}

/// What would help a refused picture; null when nothing is known.
Json proposal_json(const std::optional<vision::Proposal>& proposal) {
  if (!proposal) return nullptr;
  return {{"exclude", box_json(proposal->excluded)},
          {"heap", box_json(proposal->heap)},
          {"ground", line_json(proposal->ground)},
          {"angle_deg", degrees(proposal->angle_rad)},
          {"uncertainty_deg", degrees(proposal->uncertainty_rad)}};
}

Json lens_json(const MeasuredPicture& picture) {
  if (!picture.lens) return nullptr;
  const vision::Lens& lens = *picture.lens;
  return {{"file", picture.told.scale.lens_file.string()},
          {"focal_px", lens.focal_px.value},
          {"centre_px", {lens.centre_x_px.value, lens.centre_y_px.value}},
          {"distortion",
           {{"k1", lens.k1.value},
            {"k2", lens.k2.value},
            {"p1", lens.p1.value},
            {"p2", lens.p2.value},
            {"k3", lens.k3.value}}}};
}

void add_degrees(Json& json, const std::string& name,
                 const std::optional<vision::Estimate>& estimate_rad) {
  json[name + "_deg"] = estimate_rad ? Json(rounded_degrees(estimate_rad->value)) : Json();
  json[name + "_uncertainty_deg"] =
      estimate_rad ? Json(rounded_degrees(estimate_rad->uncertainty)) : Json();
}

Json board_json(const std::optional<vision::SeenBoard>& board) {
  if (!board) return nullptr;
  Json json{{"corners", board->corners},
            {"error_px", board->error_px},
            {"outline", places_json(board->outline)}};
  add_degrees(json, "pitch", board->pitch_rad);
  add_degrees(json, "roll", board->roll_rad);
  add_estimate(json, "distance_mm", board->distance_mm);
  json["missing"] = board->missing.empty() ? Json() : Json(board->missing);
  return json;
}

/// Lens, board, and what they make of the heap.
void add_sizes(const MeasuredPicture& picture, Json& json) {
  const vision::HeapSizes& sizes = picture.sizes;
  json["camera"] = lens_json(picture);
  json["board"] = board_json(picture.board);
  json["scale"] = !picture.has_scale ? Json() : Json(picture.board ? "board" : "given");
  add_estimate(json, "mm_per_px", sizes.mm_per_px);
  add_estimate(json, "height_mm", sizes.height_mm);
  add_estimate(json, "base_mm", sizes.base_mm);
  add_estimate(json, "cone_volume_ml", sizes.cone_volume_ml);
  add_estimate(json["left"], "run_out_mm", sizes.left_run_out_mm);
  add_estimate(json["right"], "run_out_mm", sizes.right_run_out_mm);
  json["size_reason"] = sizes.reason.empty() ? Json() : Json(sizes.reason);
}

/// What part of a film it is; all null of a picture.
void add_film(const std::optional<FilmedPicture>& filmed, Json& json) {
  json["film"] = filmed ? film_json(filmed->film) : Json();
  json["stretch"] = nullptr;
  if (filmed && filmed->stretch) {
    const vision::FilmStretch& stretch = *filmed->stretch;
    json["stretch"] = {
        {"from_s", stretch.from_s}, {"to_s", stretch.to_s}, {"frames", stretch.frames}};
  }
  json["time_s"] = filmed ? or_null(filmed->time_s) : Json();
}

Json picture_json(const MeasuredPicture& picture) {
  const vision::ReposeAngle& angle = picture.angle;
  Json json{{"file", picture.file},
            {"copy_of", picture.copy_of.empty() ? Json() : Json(picture.copy_of)},
            {"heap", picture.heap.empty() ? Json() : Json(picture.heap)},
            {"status", name_of(angle.status)},
            {"angle_deg", degrees(angle.angle_rad)},
            {"uncertainty_deg", degrees(angle.uncertainty_rad)},
            {"camera_uncertainty_deg", degrees(angle.camera_uncertainty_rad)},
            {"left", flank_json(angle.left)},
            {"right", flank_json(angle.right)},
            {"ground_tilt_deg", degrees(angle.ground_tilt_rad)},
            {"window", angle.window},
            {"method", name_of(angle.method)},
            {"pitch_deg", degrees(angle.camera_pitch_rad)},
            {"confidence", angle.confidence},
            {"warnings", warnings_json(angle.warnings)},
            {"excluded", excluded_json(picture.told.measuring.excluded)},
            {"hints", hints_json(picture.told.measuring.hints)},
            {"proposal", proposal_json(picture.proposal)},
            {"segmentation", angle.segmentation},
            {"strays", angle.strays},
            {"grain_px", or_null(angle.grain_px)},
            {"height_px", or_null(angle.height_px)},
            {"base_px", or_null(angle.base_px)},
            {"definitions", definitions_json(angle.definitions)}};
  add_sizes(picture, json);
  add_film(picture.filmed, json);
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
  return json_text(pictures, picture_json);
}

}  // namespace repose::cli
