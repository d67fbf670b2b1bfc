#include "calibrate/measured/measured_json.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "calibrate/measured/json_text.h"
#include "calibrate/measured/measured_columns.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scanned_heap.h"

namespace repose::calibrate {

namespace {

/// One row, field by field.
class Row {
 public:
  void add_text(std::string_view text) { fields_.emplace_back(text); }
  void add_number(const std::optional<double>& value) {
    fields_.push_back(value ? fmt::format("{}", *value) : "");
  }
  void add_count(int value) { fields_.push_back(fmt::format("{}", value)); }
  void add_degrees(const std::optional<double>& angle_rad) {
    add_number(angle_rad ? std::optional(rounded_degrees(*angle_rad)) : std::nullopt);
  }
  std::vector<std::string> cells() && { return std::move(fields_); }

 private:
  std::vector<std::string> fields_;
};

void add_flank(Row& row, const vision::Flank& flank) {
  row.add_text(name_of(flank.status));
  row.add_degrees(flank.angle_rad);
  row.add_degrees(flank.uncertainty_rad);
  row.add_number(flank.r2);
  row.add_count(flank.points);
}

std::string warning_codes(const std::vector<vision::Warning>& warnings) {
  std::vector<std::string> codes;
  codes.reserve(warnings.size());
  for (const vision::Warning& warning : warnings) codes.push_back(warning.code);
  return fmt::format("{}", fmt::join(codes, ";"));
}

/// Empty for pictures.
void add_film(Row& row, const std::optional<FilmedPicture>& filmed) {
  constexpr int kFields = 5;
  if (!filmed) {
    for (int field = 0; field < kFields; ++field) row.add_text("");
    return;
  }
  const auto& stretch = filmed->stretch;
  row.add_number(filmed->time_s);
  row.add_number(stretch ? std::optional(stretch->from_s) : std::nullopt);
  row.add_number(stretch ? std::optional(stretch->to_s) : std::nullopt);
  row.add_text(stretch ? fmt::format("{}", stretch->frames) : "");
  row.add_number(filmed->film.frames_per_s);
}

/// The source of millimetres; empty: none.
std::string_view scale_name(const MeasuredPicture& picture) {
  if (!picture.has_scale) return {};
  if (picture.positions) return "positions";
  return picture.board ? "board" : "given";
}

/// Empty without a scale.
void add_sizes(Row& row, const MeasuredPicture& picture) {
  const vision::HeapSizes& sizes = picture.sizes;
  row.add_text(picture.lens ? picture.told.scale.lens_file.string() : "");
  row.add_text(scale_name(picture));
  for (const auto* estimate :
       {&sizes.mm_per_px, &sizes.height_mm, &sizes.base_mm, &sizes.cone_volume_ml,
        &sizes.left_run_out_mm, &sizes.right_run_out_mm}) {
    row.add_number(*estimate ? std::optional((*estimate)->value) : std::nullopt);
    row.add_number(*estimate ? std::optional((*estimate)->uncertainty) : std::nullopt);
  }
  row.add_text(sizes.reason);
}

int azimuths_with_angle(const vision::ScannedHeap& scan) {
  return static_cast<int>(
      std::count_if(scan.azimuths.begin(), scan.azimuths.end(),
                    [](const vision::Azimuth& azimuth) { return azimuth.angle_rad.has_value(); }));
}

/// Empty for pictures.
void add_scan(Row& row, const std::optional<vision::ScannedHeap>& scan) {
  const auto volume = scan ? scan->volume_ml : std::nullopt;
  row.add_number(volume ? std::optional(volume->value) : std::nullopt);
  row.add_number(volume ? std::optional(volume->uncertainty) : std::nullopt);
  row.add_text(scan ? fmt::format("{}", azimuths_with_angle(*scan)) : "");
  row.add_degrees(scan ? scan->azimuth_sd_rad : std::nullopt);
}

/// For scans; fields that only pictures have stay empty.
std::vector<std::string> scan_cells(const MeasuredPicture& picture) {
  constexpr int kOfSides = 11;    // from left_status to ground_tilt_deg
  constexpr int kOfPictures = 7;  // from segmentation to hints
  const vision::ReposeAngle& angle = picture.angle;
  Row row;
  row.add_text(picture.file);
  row.add_text(name_of(angle.status));
  row.add_degrees(angle.angle_rad);
  row.add_degrees(angle.uncertainty_rad);
  for (int field = 0; field < kOfSides; ++field) row.add_text("");
  row.add_number(angle.window[0]);
  row.add_number(angle.window[1]);
  row.add_text(name_of(angle.method));
  for (int field = 0; field < kOfPictures; ++field) row.add_text("");
  row.add_text(warning_codes(angle.warnings));
  row.add_text(angle.reason);
  add_film(row, picture.filmed);
  add_sizes(row, picture);
  add_scan(row, picture.scan);
  row.add_text(angle.definition);
  return std::move(row).cells();
}

std::vector<std::string> picture_cells(const MeasuredPicture& picture) {
  const vision::ReposeAngle& angle = picture.angle;
  Row row;
  row.add_text(picture.file);
  row.add_text(name_of(angle.status));
  row.add_degrees(angle.angle_rad);
  row.add_degrees(angle.uncertainty_rad);
  add_flank(row, angle.left);
  add_flank(row, angle.right);
  row.add_degrees(angle.ground_tilt_rad);
  row.add_number(angle.window[0]);
  row.add_number(angle.window[1]);
  row.add_text(name_of(angle.method));
  row.add_text(angle.segmentation);
  row.add_number(angle.confidence);
  row.add_count(angle.loose_particles);
  row.add_number(angle.grain_px);
  row.add_number(angle.height_px);
  row.add_number(angle.base_px);
  row.add_text(picture.told.measuring.hints.text());
  row.add_text(warning_codes(angle.warnings));
  row.add_text(angle.reason);
  add_film(row, picture.filmed);
  add_sizes(row, picture);
  add_scan(row, picture.scan);
  row.add_text(angle.definition);
  return std::move(row).cells();
}

/// Only the reason is known.
std::vector<std::string> unread_cells(const MeasuredPicture& picture) {
  constexpr int kUnknownFields = 24;  // between status and reason
  Row row;
  row.add_text(picture.file);
  row.add_text(name_of(vision::MeasureStatus::refused));
  for (int field = 0; field < kUnknownFields; ++field) row.add_text("");
  row.add_text(picture.error);
  add_film(row, picture.filmed);
  add_sizes(row, picture);
  add_scan(row, picture.scan);
  row.add_text("");
  return std::move(row).cells();
}

}  // namespace

std::vector<std::string> measured_cells(const MeasuredPicture& picture) {
  if (picture.outcome != Outcome::measured) return unread_cells(picture);
  return picture.scan ? scan_cells(picture) : picture_cells(picture);
}

std::string measure_csv(const std::vector<MeasuredPicture>& pictures) {
  std::vector<std::string> header;
  for (const MeasuredColumn& column : measured_columns()) header.emplace_back(column.name);
  std::string csv = base::csv_row(header);
  for (const MeasuredPicture& picture : pictures) csv += base::csv_row(measured_cells(picture));
  return csv;
}

namespace {

using Json = nlohmann::ordered_json;

/// A length and its half-width; null if there is none.
void add_estimate(Json& json, const std::string& key,
                  const std::optional<vision::Estimate>& estimate) {
  json[key] = estimate ? Json(estimate->value) : Json();
  json[key + "_uncertainty"] = estimate ? Json(estimate->uncertainty) : Json();
}

Json apron_json(const std::optional<vision::FlankApron>& apron) {
  if (!apron) return nullptr;
  return {{"from", apron->from},
          {"length_px", apron->length_px},
          {"angle_with_deg", rounded_degrees(apron->angle_with_rad)}};
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
            {"other_windows", windows},
            {"apron", apron_json(flank.apron)}};
  if (flank.status != vision::FlankStatus::ok) json["reason"] = flank.reason;
  return json;
}

Json definitions_json(const std::vector<vision::NamedAngle>& definitions) {
  Json json = Json::array();
  for (const vision::NamedAngle& definition : definitions) {
    json.push_back({{"name", definition.name},
                    {"description", definition.description},
                    {"angle_deg", rounded_degrees(definition.angle_rad)},
                    {"uncertainty_deg", degrees(definition.uncertainty_rad)}});
  }
  return json;
}

/// The user's hints on the picture; null if there are none.
Json hints_json(const vision::Hints& hints) {
  if (hints.empty() && hints.source.empty()) return nullptr;
  return {{"rotate_deg", hints.turn_deg == 0 ? Json() : Json(hints.turn_deg)},
          {"heap", box_json(hints.heap)},
          {"half", hints.half ? Json(name_of(*hints.half)) : Json()},
          {"ground", line_json(hints.ground)},
          {"keep", places_json(hints.keep)},
          {"drop", places_json(hints.drop)},
          {"mask", hints.mask.width > 0},
          {"file", hints.source.empty() ? Json() : Json(hints.source)}};
}

/// What would help a refused picture; null if unknown.
Json proposal_json(const std::optional<vision::Proposal>& proposal) {
  if (!proposal) return nullptr;
  return {{"rotate_deg", proposal->turn_deg == 0 ? Json() : Json(proposal->turn_deg)},
          {"exclude", box_json(proposal->excluded)},
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

/// Lens, board, and the heap's sizes derived from them.
void add_sizes(const MeasuredPicture& picture, Json& json) {
  const vision::HeapSizes& sizes = picture.sizes;
  json["camera"] = lens_json(picture);
  json["board"] = board_json(picture.board);
  json["scale"] = picture.has_scale ? Json(scale_name(picture)) : Json();
  add_estimate(json, "mm_per_px", sizes.mm_per_px);
  add_estimate(json, "height_mm", sizes.height_mm);
  add_estimate(json, "base_mm", sizes.base_mm);
  add_estimate(json, "cone_volume_ml", sizes.cone_volume_ml);
  add_estimate(json["left"], "run_out_mm", sizes.left_run_out_mm);
  add_estimate(json["right"], "run_out_mm", sizes.right_run_out_mm);
  json["size_reason"] = sizes.reason.empty() ? Json() : Json(sizes.reason);
}

/// Which part of a film it is; all null for a picture.
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

Json azimuths_json(const std::vector<vision::Azimuth>& azimuths) {
  Json json = Json::array();
  for (const vision::Azimuth& azimuth : azimuths) {
    Json one{{"azimuth_deg", rounded_degrees(azimuth.azimuth_rad)},
             {"status", name_of(azimuth.status)},
             {"angle_deg", degrees(azimuth.angle_rad)}};
    if (azimuth.status != vision::FlankStatus::ok) one["reason"] = azimuth.reason;
    json.push_back(std::move(one));
  }
  return json;
}

Json ground_json(const std::optional<vision::ScanGround>& ground) {
  if (!ground) return nullptr;
  return {{"normal", ground->normal},
          {"offset", ground->offset},
          {"noise", ground->noise},
          {"level_sd", ground->level_sd},
          {"sectors", ground->sectors}};
}

Json silhouettes_json(const std::optional<ScanViews>& silhouettes) {
  if (!silhouettes) return nullptr;
  const vision::ReposeAngle& angle = silhouettes->angle;
  return {{"status", name_of(angle.status)},
          {"reason", angle.reason},
          {"angle_deg", degrees(angle.angle_rad)},
          {"uncertainty_deg", degrees(angle.uncertainty_rad)},
          {"between_views_deg", degrees(silhouettes->between_views_rad)}};
}

/// Fields that only scans have, null for pictures; fields that only pictures have are null for
/// scans.
void add_scan(const MeasuredPicture& picture, Json& json) {
  const std::optional<vision::ScannedHeap>& scan = picture.scan;
  add_estimate(json, "volume_ml", scan ? scan->volume_ml : std::nullopt);
  json["scan"] = nullptr;
  if (!scan) return;
  for (const char* unknown : {"left", "right", "confidence", "segmentation", "strays"}) {
    json[unknown] = nullptr;
  }
  json["scan"] = {{"points", scan->points},
                  {"points_left_out", scan->points_left_out},
                  {"ground", ground_json(scan->ground)},
                  {"axis", scan->axis ? Json(*scan->axis) : Json()},
                  {"hole_share", scan->hole_share},
                  {"azimuths", azimuths_json(scan->azimuths)},
                  {"azimuth_sd_deg", degrees(scan->azimuth_sd_rad)},
                  {"silhouettes", silhouettes_json(picture.silhouettes)}};
}

/// For particle files: their content, and the result of each view.
Json positions_json(const std::optional<MeasuredPositions>& positions) {
  if (!positions) return nullptr;
  const PositionsFile& file = positions->file;
  Json views = Json::array();
  for (const vision::ReposeAngle& view : positions->views) {
    const double turn =
        static_cast<double>(views.size()) / static_cast<double>(positions->views.size());
    views.push_back({{"azimuth_deg", rounded_degrees(std::numbers::pi * turn)},
                     {"status", name_of(view.status)},
                     {"angle_deg", degrees(view.angle_rad)},
                     {"uncertainty_deg", degrees(view.uncertainty_rad)}});
  }
  return {{"format", file.format},
          {"unit", file.unit.empty() ? Json() : Json(file.unit)},
          {"step", file.step.empty() ? Json() : Json(file.step)},
          {"steps", file.steps},
          {"particles", file.heap.grains},
          {"spheres", file.heap.spheres},
          {"up", name_of(file.up)},
          {"plate", file.heap.plate},
          {"plate_from", file.heap.is_plate_given ? "given" : "found"},
          {"below_plate", file.heap.below_plate},
          {"in_the_air", file.heap.in_the_air},
          {"between_views_deg", degrees(positions->between_views_rad)},
          {"views", views}};
}

}  // namespace

Json measured_json(const MeasuredPicture& picture) {
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
            {"definition", angle.definition.empty() ? Json() : Json(angle.definition)},
            {"window", angle.window},
            {"method", name_of(angle.method)},
            {"pitch_deg", degrees(angle.camera_pitch_rad)},
            {"confidence", angle.confidence},
            {"warnings", warnings_json(angle.warnings)},
            {"excluded", boxes_json(picture.told.measuring.excluded)},
            {"hints", hints_json(picture.told.measuring.hints)},
            {"proposal", proposal_json(picture.proposal)},
            {"segmentation", angle.segmentation},
            {"strays", angle.loose_particles},
            {"grain_px", or_null(angle.grain_px)},
            {"height_px", or_null(angle.height_px)},
            {"base_px", or_null(angle.base_px)},
            {"definitions", definitions_json(angle.definitions)}};
  add_sizes(picture, json);
  add_film(picture.filmed, json);
  add_scan(picture, json);
  json["positions"] = positions_json(picture.positions);
  if (picture.outcome != Outcome::measured) {
    json["reason"] = picture.error;
    for (const char* unknown :
         {"definition", "window", "method", "confidence", "segmentation", "strays"}) {
      json[unknown] = nullptr;
    }
  } else if (angle.status == vision::MeasureStatus::refused) {
    json["reason"] = angle.reason;
  }
  return json;
}

std::string measure_json(const std::vector<MeasuredPicture>& pictures) {
  return json_text(pictures, measured_json);
}

}  // namespace repose::calibrate
