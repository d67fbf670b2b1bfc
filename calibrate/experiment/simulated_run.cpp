#include "calibrate/experiment/simulated_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/units.h"
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

/// What holds for each run that was made.
bool holds_together(const SimulatedRun& run) {
  const auto is_reading = [](const auto& reading) { return is_possible(reading.second); };
  return is_possible(run.value) &&
         std::all_of(run.readings.begin(), run.readings.end(), is_reading) && run.steps >= 0 &&
         run.clump_steps >= 0 && run.timestep_s >= 0 && run.wall_s >= 0 &&
         (!run.failure.empty() || (!run.readings.empty() && run.timestep_s > 0));
}

SimulatedRun run_in(const Json& json) {
  SimulatedRun run;
  run.seed = json.at("seed");
  run.value = number_or_nan(json.at("value"));
  for (const auto& [name, value] : json.at("readings").items()) {
    run.readings[name] = number_or_nan(value);
  }
  run.steps = json.at("steps");
  run.timestep_s = json.at("timestep_s");
  run.clump_steps = json.at("clump_steps");
  for (const Json& view : json.at("views")) {
    run.views.push_back({.azimuth_rad = view.at("azimuth_rad"),
                         .picture = {.status = status_named(view.at("status")),
                                     .angle_rad = number_in(view.at("angle_rad"))}});
  }
  // Earlier versions had none.
  if (const auto camera = json.find("camera"); camera != json.end() && !camera->is_null()) {
    run.camera = {.distance_m = camera->at("distance_m"), .height_m = camera->at("height_m")};
  }
  run.failure = json.at("failure");
  run.picture_error = json.at("picture_error");
  run.wall_s = json.at("wall_s");
  run.trajectory_s = number_in(json.at("trajectory_s"));
  return run;
}

}  // namespace

bool is_pictured_as(const SimulatedRun& run, const HeapViewing& asked) {
  return run.views.size() == static_cast<std::size_t>(asked.views) && run.camera == asked.camera;
}

bool is_from_pictures(const SimulatedRun& run) { return is_well_pictured(run.views); }

double value_of(const SimulatedRun& run) {
  return is_from_pictures(run) ? mean_of_views(run.views).angle_deg.value().mean : run.value;
}

std::map<std::string, double> readings_of(const SimulatedRun& run) {
  if (!run.failure.empty()) return {};
  std::map<std::string, double> readings = run.readings;
  readings["value"] = value_of(run);
  readings["timestep_s"] = run.timestep_s;
  if (!run.views.empty()) {
    const PictureMean seen = mean_of_views(run.views);
    readings["angle_from_positions_deg"] = run.value;
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
  }
  Json camera;
  if (run.camera) {
    camera = {{"distance_m", run.camera->distance_m}, {"height_m", run.camera->height_m}};
  }
  return Json{{"seed", run.seed},
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
              {"trajectory_s", json_of(run.trajectory_s)}}
      .dump();
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
