#include "calibrate/experiment/simulated_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/angle_definition.h"
#include "base/units.h"
#include "dem/experiment/heap_envelope.h"
#include "vision/measure/status_name.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::optional<double> number) {
  return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

std::optional<double> number_in(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

double number_or_nan(const Json& json) {
  return number_in(json).value_or(std::numeric_limits<double>::quiet_NaN());
}

vision::MeasureStatus status_named(const std::string& name) {
  for (const auto status : {vision::MeasureStatus::ok, vision::MeasureStatus::flagged}) {
    if (name == name_of(status)) return status;
  }
  return vision::MeasureStatus::refused;
}

/// Degrees, millimetres and counts of a bench are far less. A fit does not end with such numbers.
constexpr double kMostReading = 1e9;

bool is_possible(double reading) { return !(std::abs(reading) > kMostReading); }

std::optional<double> reading_in(const SimulatedRun& run, const std::string& name) {
  const auto found = run.readings.find(name);
  if (found == run.readings.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second;
}

constexpr const char* kNoHeap = "no_heap";

/// Takes out what earlier versions wrote for a heap without an angle: 0, which no line that is
/// measured has, since level ones are none, and of a layer what its edge gave.
void drop_angles_of_none(SimulatedRun& run) {
  const auto is_layer = reading_in(run, kNoHeap);
  if (!is_layer) return;
  const auto is_none = [&](double angle) { return *is_layer != 0 || angle == 0; };
  if (run.value && is_none(*run.value)) run.value.reset();
  for (const char* name : {"angle_xz_deg", "inner_window_deg", "base_radius_mm"}) {
    const auto found = run.readings.find(name);
    if (found == run.readings.end() || !is_none(found->second)) continue;
    found->second = std::numeric_limits<double>::quiet_NaN();
  }
  if (*is_layer == 0) return;
  run.views.clear();
  run.other_deg.clear();
}

/// What holds for each run that was made.
bool holds_together(const SimulatedRun& run) {
  const auto is_reading = [](const auto& reading) { return is_possible(reading.second); };
  return is_possible(run.value.value_or(0)) &&
         std::all_of(run.readings.begin(), run.readings.end(), is_reading) &&
         std::all_of(run.other_deg.begin(), run.other_deg.end(), is_reading) && run.steps >= 0 &&
         run.clump_steps >= 0 && run.timestep_s >= 0 && run.wall_s >= 0 &&
         (!run.failure.empty() || (!run.readings.empty() && run.timestep_s > 0));
}

/// Earlier versions had none.
std::map<std::string, double> others_in(const Json& json, const char* key) {
  return json.value(key, std::map<std::string, double>());
}

SimulatedRun run_in(const Json& json) {
  SimulatedRun run;
  run.seed = json.at("seed");
  run.value = number_in(json.at("value"));
  for (const auto& [name, value] : json.at("readings").items()) {
    run.readings[name] = number_or_nan(value);
  }
  run.steps = json.at("steps");
  run.timestep_s = json.at("timestep_s");
  run.clump_steps = json.at("clump_steps");
  for (const Json& view : json.at("views")) {
    run.views.push_back({.azimuth_rad = view.at("azimuth_rad"),
                         .picture = {.status = status_named(view.at("status")),
                                     .angle_rad = number_in(view.at("angle_rad")),
                                     .other_rad = others_in(view, "other_rad")}});
  }
  run.other_deg = others_in(json, "other_deg");
  // Earlier versions had none.
  if (const auto camera = json.find("camera"); camera != json.end() && !camera->is_null()) {
    run.camera = {.distance_m = camera->at("distance_m"), .height_m = camera->at("height_m")};
  }
  run.failure = json.at("failure");
  run.picture_error = json.at("picture_error");
  run.wall_s = json.at("wall_s");
  run.trajectory_s = number_in(json.at("trajectory_s"));
  drop_angles_of_none(run);
  if (run.failure.empty()) run.failure = no_heap_reason(run);
  return run;
}

}  // namespace

std::string no_heap_reason(const SimulatedRun& run) {
  const auto is_layer = reading_in(run, kNoHeap);
  if (!is_layer) return {};
  const auto height_mm = reading_in(run, "height_mm");
  const std::string height = height_mm ? fmt::format(" {:.3g} mm high", *height_mm) : std::string();
  if (*is_layer != 0) {
    return fmt::format(
        "heap: the grains spread to a layer{}. Rule: a heap is at least {:g} grain diameters high; "
        "the edge of a layer is no angle of repose. Fix: more grains, or more sliding or rolling "
        "friction.",
        height, dem::kLowestHeap);
  }
  if (run.value) return {};
  return fmt::format(
      "heap: the grains stand{} and slope to less than half of the sides, as a column that did not "
      "collapse: an upright face has no angle of repose. Fix: less friction, a lower tube, or more "
      "grains.",
      height);
}

bool is_pictured_as(const SimulatedRun& run, const HeapViewing& asked) {
  return run.views.size() == static_cast<std::size_t>(asked.views) && run.camera == asked.camera;
}

bool has_definition(const SimulatedRun& run, const std::string& definition) {
  if (base::is_usual_definition(definition) || !run.failure.empty()) return true;
  const auto lacks = [](const HeapView& view) {
    return counts_in_mean(view.picture.status) && view.picture.other_rad.empty();
  };
  return !(run.value && run.other_deg.empty()) &&
         std::none_of(run.views.begin(), run.views.end(), lacks);
}

PictureMean picture_mean(const SimulatedRun& run) {
  return mean_of_views(run.views, run.definition);
}

std::optional<double> position_value(const SimulatedRun& run) {
  if (base::is_usual_definition(run.definition)) return run.value;
  const auto found = run.other_deg.find(run.definition);
  return found == run.other_deg.end() ? std::nullopt : std::optional(found->second);
}

bool is_from_pictures(const SimulatedRun& run) {
  return is_well_pictured(run.views, run.definition);
}

std::optional<double> value_of(const SimulatedRun& run) {
  if (!run.failure.empty()) return std::nullopt;
  return is_from_pictures(run) ? picture_mean(run).angle_deg.value().mean : position_value(run);
}

std::vector<std::pair<std::string, double>> values_by_definition(const SimulatedRun& run) {
  std::vector<std::pair<std::string, double>> values;
  if (!run.readings.contains(kNoHeap)) return values;
  SimulatedRun read = run;
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    read.definition = definition.name;
    if (const auto value = value_of(read)) values.emplace_back(definition.name, *value);
  }
  return values;
}

std::map<std::string, double> readings_of(const SimulatedRun& run) {
  if (!run.failure.empty()) return {};
  std::map<std::string, double> readings = run.readings;
  if (const auto value = value_of(run)) readings["value"] = *value;
  readings["timestep_s"] = run.timestep_s;
  if (!run.views.empty()) {
    const PictureMean seen = picture_mean(run);
    if (const auto angle = position_value(run)) readings["angle_from_positions_deg"] = *angle;
    readings["views_measured"] = static_cast<double>(run.views.size()) - seen.refused;
    readings["views_flagged"] = seen.flagged;
    readings["from_pictures"] = is_from_pictures(run) ? 1 : 0;
    if (seen.angle_deg) {
      readings["angle_from_pictures_deg"] = seen.angle_deg->mean;
      if (seen.angle_deg->sd) {
        readings["sd_between_views_deg"] = *seen.angle_deg->sd;
        readings[kOneViewScatter] =
            *seen.angle_deg->sd * std::sqrt(1 - 1 / readings.at("views_measured"));
      }
    }
  }
  std::erase_if(readings, [](const auto& reading) { return !std::isfinite(reading.second); });
  return readings;
}

std::string warning_of_hops(dem::RollingModel rolling, const dem::ClumpShape& grain,
                            double hop_mm) {
  constexpr double kHop = .01;  // in reaches of the grain; a ball loses 3 % then
  if (rolling != dem::RollingModel::elastic_plastic) return {};
  if (!(hop_mm > kHop * kMmPerM * grain.reach_m())) return {};
  return fmt::format(
      "rolls with elastic_plastic: the grain hops along the flat by up to {:.2g} mm, and this law "
      "takes speed at each landing, of a ball up to (1 + restitution) times the rolling friction: "
      "its damper is not limited by the rolling friction. So the distance depends much on the "
      "restitution, and hardly does on a bench. Fix: a gentler incline, so that it does not hop; "
      "or rolling_model = \"constant_torque\".",
      hop_mm);
}

std::string run_text(const SimulatedRun& run) {
  Json readings = Json::object();
  for (const auto& [name, value] : run.readings) readings[name] = json_of(value);
  Json views = Json::array();
  for (const HeapView& view : run.views) {
    views.push_back({{"azimuth_rad", view.azimuth_rad},
                     {"status", name_of(view.picture.status)},
                     {"angle_rad", json_of(view.picture.angle_rad)}});
    if (!view.picture.other_rad.empty()) views.back()["other_rad"] = view.picture.other_rad;
  }
  Json camera;
  if (run.camera) {
    camera = {{"distance_m", run.camera->distance_m}, {"height_m", run.camera->height_m}};
  }
  Json json{{"seed", run.seed},
            {"value", json_of(run.value)},
            {"readings", readings},
            {"steps", run.steps},
            {"timestep_s", run.timestep_s},
            {"clump_steps", run.clump_steps},
            {"views", views},
            {"camera", camera},
            {"failure", run.failure},
            {"picture_error", run.picture_error},
            {"wall_s", run.wall_s},
            {"trajectory_s", json_of(run.trajectory_s)}};
  if (!run.other_deg.empty()) json["other_deg"] = run.other_deg;
  return json.dump();
}

std::optional<SimulatedRun> run_in(const std::string& text) {
  try {
    SimulatedRun run = run_in(Json::parse(text));
    if (holds_together(run)) return run;
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace repose::calibrate
