#include "cli/simulate/simulate_json.h"

#include <algorithm>
#include <cmath>

#include "base/angle_definition.h"
#include "base/version.h"
#include "calibrate/experiment/model_fields.h"
#include "cli/common/degrees.h"
#include "cli/simulate/simulate_values.h"
#include "cli/simulate/simulate_warnings.h"
#include "dem/contact/damping_name.h"
#include "dem/contact/rolling_name.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using calibrate::Json;

constexpr int kIndent = 2;
constexpr double kMillimetres = 1e3;

std::string text_of(const Json& json) {
  // Names of files need not be UTF-8, JSON must be.
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// JSON has no NaN: a number that does not exist is null.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json material_json(const dem::Material& material) {
  Json json{{"name", material.name}};
  json.update(calibrate::json_of_fields(material));
  return json;
}

Json clump_json(const SimulatePlan& plan) {
  const dem::ClumpShape& shape = plan.grain.shape;
  const auto smallest =
      std::min_element(shape.spheres.begin(), shape.spheres.end(),
                       [](const auto& a, const auto& b) { return a.radius < b.radius; });
  return {{"source", plan.grain.source},
          {"spheres", shape.spheres.size()},
          {"smallest_radius_mm", smallest->radius * kMillimetres},
          {"mass_g", shape.volume_m3 * plan.spec.model.grain_material.density_kg_m3 * 1e3},
          {"volume_error", plan.grain.errors.volume_error},
          {"inertia_error", plan.grain.errors.inertia_error},
          {"size_sd_percent", 100 * plan.spec.model.size_sd_fraction}};
}

/// All that a value belongs to but its seed and time step.
void add_context(const SimulatePlan& plan, Json& json) {
  const dem::Model& model = plan.spec.model;
  json["contact_model"] = dem::kContactModel;
  json["rolling_model"] = dem::name_of(model.rolling);
  json["rolling_definition"] = dem::rolling_definition(model.rolling);
  json["damping"] = dem::name_of(model.damping);
  json["damping_definition"] = dem::damping_definition(model);
  json["stiffness_factor"] = model.stiffness_factor;
  json["timestep_fraction"] = model.timestep_s ? Json(nullptr) : Json(model.timestep_fraction);
  json["clump"] = clump_json(plan);
  json["materials"] = {{"particle", material_json(model.grain_material)},
                       {"wall", material_json(model.wall_material)}};
  json["contact"] = {{"particle_wall", calibrate::json_of_fields(model.grain_wall)}};
  if (dem::has_grain_contacts(plan.experiment)) {
    json["contact"]["particle_particle"] = calibrate::json_of_fields(model.grain_grain);
  }
  for (const auto& [part, surface] : model.parts) {
    json["materials"][name_of(part)] = material_json(surface.material);
    json["contact"]["particle_" + name_of(part)] = calibrate::json_of_fields(surface.with_grain);
  }
  json["study"] = {
      {"file", plan.study.file.string()}, {"hash", plan.study.hash}, {"settings", plan.settings}};
  json["program"] = base::kProgram;
}

Json finite_value_or_null(const std::optional<double>& value) {
  return value ? finite_or_null(*value) : Json(nullptr);
}

Json object_of(const std::vector<std::pair<std::string, double>>& numbers) {
  Json json = Json::object();
  for (const auto& [name, number] : numbers) json[name] = finite_or_null(number);
  return json;
}

/// A heap's angle from both sources, and each view of it.
void add_pictures(const Run& run, Json& json) {
  const calibrate::RunResult& result = run.result;
  const auto seen = calibrate::picture_mean(result).angle_deg;
  json["source"] = calibrate::is_from_pictures(result) ? "pictures" : "positions";
  json["angle_from_pictures_deg"] = seen ? finite_or_null(seen->mean) : Json(nullptr);
  json["sd_between_views_deg"] = seen ? finite_value_or_null(seen->sd) : Json(nullptr);
  json["angle_from_positions_deg"] = finite_value_or_null(calibrate::position_value(result));
  json["views"] = Json::array();
  for (const calibrate::HeapView& view : result.views) {
    const auto angle = calibrate::angle_by(view.picture, result.definition);
    json["views"].push_back({{"azimuth_deg", rounded_degrees(view.azimuth_rad)},
                             {"status", name_of(view.picture.status)},
                             {"angle_deg", angle ? Json(rounded_degrees(*angle)) : Json(nullptr)}});
  }
}

/// The same for all repeats together, and where they were seen from.
void add_sources(const SimulatePlan& plan, const std::vector<Run>& runs, Json& json) {
  const auto angles = heap_angles(runs);
  if (!angles) return;
  json["source"] = source_of(runs);
  const auto& pictures = angles->pictures;
  json["angle_from_pictures_deg"] = pictures ? Json(pictures->mean) : Json(nullptr);
  const auto& positions = angles->positions;
  json["angle_from_positions_deg"] = positions ? Json(positions->mean) : Json(nullptr);
  json["sd_from_pictures_deg"] = pictures ? finite_value_or_null(pictures->sd) : Json(nullptr);
  json["sd_from_positions_deg"] = positions ? finite_value_or_null(positions->sd) : Json(nullptr);
  json["sd_between_views_deg"] = finite_value_or_null(angles->between_views_pictures);
  json["views"] = angles->views;
  json["views_refused"] = angles->refused;
  json["views_flagged"] = angles->flagged;
  json["camera_mm"] = nullptr;
  if (const auto& camera = plan.spec.viewing.camera) {
    json["camera_mm"] = {1000 * camera->distance_m, 1000 * camera->height_m};
  }
}

Json run_json(const Run& run) {
  const calibrate::RunResult& result = run.result;
  Json readings = Json::object();
  for (const auto& [name, value] : result.readings) readings[name] = finite_value_or_null(value);
  Json json{{"seed", result.seed},
            {"value", finite_value_or_null(calibrate::value_of(result))},
            {"reason", result.failure.empty() ? Json(nullptr) : Json(result.failure)},
            {"wall_s", result.wall_s},
            {"steps", result.steps},
            {"clump_steps_per_s", finite_or_null(result.clump_steps / result.wall_s)},
            {"timestep_s", result.timestep_s},
            {"state", run.state_file.empty() ? Json(nullptr) : Json(run.state_file)},
            {"overlay", run.overlay_file.empty() ? Json(nullptr) : Json(run.overlay_file)},
            {"readings", readings}};
  if (!result.views.empty()) add_pictures(run, json);
  const auto definitions = calibrate::values_by_definition(result);
  if (!definitions.empty()) json["definitions_deg"] = object_of(definitions);
  return json;
}

Json measured_json(const dem::Measured& measured) {
  Json json{{"values", measured.values},
            {"mean", measured.mean ? Json(*measured.mean) : Json(nullptr)},
            {"sd", measured.sd ? Json(*measured.sd) : Json(nullptr)},
            {"n", measured.count ? Json(*measured.count) : Json(nullptr)}};
  if (measured.values.empty()) return json;
  const calibrate::Summary repeats = calibrate::summarise(measured.values);
  json["mean"] = repeats.mean;
  if (repeats.sd) json["sd"] = *repeats.sd;
  json["n"] = repeats.n;
  return json;
}

}  // namespace

std::string simulate_json(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const dem::ExperimentEntry& entry = dem::entry_of(plan.experiment);
  const auto summary = summarise(runs);
  Json json{{"experiment", entry.name}, {"unit", entry.unit}, {"value", nullptr},
            {"interval", nullptr},      {"sd", nullptr},      {"repeats", Json::array()}};
  if (summary) {
    json["value"] = summary->mean;
    if (summary->sd) json["sd"] = *summary->sd;
    if (summary->mean_uncertainty) {
      json["interval"] = {summary->mean - *summary->mean_uncertainty,
                          summary->mean + *summary->mean_uncertainty};
    }
  }
  add_sources(plan, runs, json);
  if (entry.is_pictured) {
    json["definition"] = base::definition_meant(plan.spec.definition);
    json["definitions_deg"] = object_of(means_by_definition(runs));
  }
  for (const Run& run : runs) {
    const bool has_ended = run.outcome == RunOutcome::done || run.outcome == RunOutcome::no_reading;
    if (has_ended) json["repeats"].push_back(run_json(run));
  }
  json["warnings"] = Json::array();
  // Was said when the run began.
  if (const std::string shape = dem::warning_of_shape(plan.grain); !shape.empty()) {
    json["warnings"].push_back({{"code", "shape"}, {"seed", nullptr}, {"message", shape}});
  }
  for (const RunWarning& warning : warnings_of(plan, runs)) {
    json["warnings"].push_back({{"code", warning.code},
                                {"seed", warning.seed ? Json(*warning.seed) : Json(nullptr)},
                                {"message", warning.message}});
  }
  json["measured"] = measured_json(dem::measured_in(plan.study, plan.experiment));
  json["measured"]["mean_without_air"] =
      plan.mean_without_air ? Json(*plan.mean_without_air) : Json(nullptr);
  add_context(plan, json);
  return text_of(json);
}

}  // namespace repose::cli
