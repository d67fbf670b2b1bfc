#include "calibrate/experiment/run_result.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/json_fields.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate {
namespace {

/// Degrees, millimetres and counts of a bench are far smaller. A fit does not converge with such
/// numbers.
constexpr double kMaxReading = 1e9;

bool is_possible(double reading) { return !(std::abs(reading) > kMaxReading); }

constexpr const char* kNoHeap = "no_heap";

/// Removes what earlier versions wrote for a heap without an angle: 0, which no measured line has,
/// since level ones do not count; and, for a layer, the angle of its edge.
void drop_angles_of_none(RunResult& run) {
  const auto is_layer = run.readings.number(kNoHeap);
  if (!is_layer) return;
  const auto is_none = [&](double angle) { return *is_layer != 0 || angle == 0; };
  if (run.value && is_none(*run.value)) run.value.reset();
  for (const char* name : {"angle_xz_deg", "inner_window_deg", "base_radius_mm"}) {
    const auto found = run.readings.find(name);
    if (found != run.readings.end() && is_none(found->second.value_or(0))) found->second.reset();
  }
  if (*is_layer == 0) return;
  run.views.clear();
  run.other_deg.clear();
}

/// Invariants of every completed run.
bool holds_together(const RunResult& run) {
  const auto is_number = [](const auto& reading) {
    return is_possible(reading.second.value_or(0));
  };
  const auto is_angle = [](const auto& angle) { return is_possible(angle.second); };
  return is_possible(run.value.value_or(0)) && std::ranges::all_of(run.readings, is_number) &&
         std::ranges::all_of(run.other_deg, is_angle) && run.steps >= 0 && run.clump_steps >= 0 &&
         run.timestep_s >= 0 && run.wall_s >= 0 &&
         (!run.failure.empty() || (!run.readings.empty() && run.timestep_s > 0));
}

constexpr const char* kSimulated = "simulated";
constexpr const char* kFingerprint = "fingerprint";

std::string fingerprint_of(const Json& json) { return base::fingerprint({json.dump()}); }

}  // namespace

template <typename Io>
void fields(Io& io, Held<Io, dem::LevelCamera>& camera) {
  io("distance_m", camera.distance_m);
  io("height_m", camera.height_m);
}

template <typename Io>
void fields(Io& io, Held<Io, HeapView>& view) {
  auto& picture = view.picture;
  io("azimuth_rad", view.azimuth_rad);
  io("status", picture.status);
  io("angle_rad", picture.angle_rad);
  if (io.has("other_rad", !picture.other_rad.empty())) io("other_rad", picture.other_rad);
}

/// Early versions had no cameras and no other definitions.
template <typename Io>
void fields(Io& io, Held<Io, RunResult>& run) {
  io("seed", run.seed);
  io("value", run.value);
  io("readings", run.readings);
  io("steps", run.steps);
  io("timestep_s", run.timestep_s);
  io("clump_steps", run.clump_steps);
  io("views", run.views);
  if (io.has("camera", true)) io("camera", run.camera);
  io("failure", run.failure);
  io("picture_error", run.picture_error);
  io("wall_s", run.wall_s);
  io("trajectory_s", run.trajectory_s);
  if (io.has("other_deg", !run.other_deg.empty())) io("other_deg", run.other_deg);
}

void add_position_angle(RunResult& heap) {
  const std::vector<dem::Envelope> envelopes = std::exchange(heap.envelopes, {});
  const bool is_layer = heap.readings.number("no_heap").value_or(0) != 0;
  const PositionAngle usual =
      is_layer ? PositionAngle{} : position_angle(envelopes, {.has_definitions = true});
  PositionAngle inner;
  if (usual.angle_deg) inner = position_angle(envelopes, {.window_from = .3, .window_to = .7});
  heap.value = usual.angle_deg;
  heap.other_deg = usual.other_deg;
  heap.readings["base_radius_mm"] = usual.base_radius_m;
  if (auto& radius = heap.readings["base_radius_mm"]) *radius *= 1e3;
  heap.readings["between_views_deg"] = usual.between_views_deg;
  heap.readings["angle_xz_deg"] = usual.first_view_deg;
  heap.readings["inner_window_deg"] = inner.angle_deg;
}

std::string no_heap_reason(const RunResult& run) {
  const auto is_layer = run.readings.number(kNoHeap);
  if (!is_layer) return {};
  const auto height_mm = run.readings.number("height_mm");
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

bool is_pictured_as(const RunResult& run, const HeapViewing& asked) {
  return run.views.size() == static_cast<std::size_t>(asked.views) && run.camera == asked.camera;
}

bool has_definition(const RunResult& run, const std::string& definition) {
  if (base::is_usual_definition(definition) || !run.failure.empty()) return true;
  const auto lacks = [](const HeapView& view) {
    return counts_in_mean(view.picture.status) && view.picture.other_rad.empty();
  };
  return !(run.value && run.other_deg.empty()) &&
         std::none_of(run.views.begin(), run.views.end(), lacks);
}

PictureMean picture_mean(const RunResult& run) { return mean_of_views(run.views, run.definition); }

std::optional<double> position_value(const RunResult& run) {
  if (base::is_usual_definition(run.definition)) return run.value;
  const auto found = run.other_deg.find(run.definition);
  return found == run.other_deg.end() ? std::nullopt : std::optional(found->second);
}

bool is_from_pictures(const RunResult& run) { return is_well_pictured(run.views, run.definition); }

std::optional<double> value_of(const RunResult& run) {
  if (!run.failure.empty()) return std::nullopt;
  return is_from_pictures(run) ? picture_mean(run).angle_deg.value().mean : position_value(run);
}

std::vector<std::pair<std::string, double>> values_by_definition(const RunResult& run) {
  std::vector<std::pair<std::string, double>> values;
  if (!run.readings.contains(kNoHeap)) return values;
  RunResult read = run;
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    read.definition = definition.name;
    if (const auto value = value_of(read)) values.emplace_back(definition.name, *value);
  }
  return values;
}

std::vector<std::pair<std::string, double>> means_by_definition(
    const std::vector<RunResult>& runs) {
  std::map<std::string, std::vector<double>> angles;
  for (const RunResult& run : runs) {
    for (const auto& [name, angle] : values_by_definition(run)) {
      angles[name].push_back(angle);
    }
  }
  std::vector<std::pair<std::string, double>> means;
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    const auto found = angles.find(std::string(definition.name));
    if (found == angles.end() || found->second.size() < runs.size()) continue;
    means.emplace_back(definition.name, summarise(found->second).mean);
  }
  return means;
}

std::map<std::string, double> readings_of(const RunResult& run) {
  if (!run.failure.empty()) return {};
  std::map<std::string, double> readings;
  for (const auto& [name, number] : run.readings) {
    if (number) readings[name] = *number;
  }
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
  return readings;
}

std::string warning_of_hops(dem::RollingModel rolling, const dem::ClumpShape& grain,
                            double hop_mm) {
  constexpr double kHop = .01;  // in bounding radii of the grain; a ball then loses 3 %
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

std::string text_of(const RunResult& run) {
  Json json{{kSimulated, Json::parse(run.simulated)}};
  json.update(json_of_fields(run));
  json[kFingerprint] = fingerprint_of(json);
  constexpr int kIndent = 2;
  return json.dump(kIndent) + '\n';
}

RunResult run_in(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw base::InputError({.value = "it is cut short or was changed"});
  const Json fingerprint = json.value(kFingerprint, Json());
  if (fingerprint.is_null()) {
    throw base::InputError({.value = "it has no fingerprint, as of an earlier version"});
  }
  json.erase(kFingerprint);
  RunResult run;
  try {
    read_fields(json, run);
    drop_angles_of_none(run);
    if (run.failure.empty()) run.failure = no_heap_reason(run);
  } catch (const WrongField&) {
    run = {};  // fails holds_together()
  }
  if (fingerprint != fingerprint_of(json) || !json.contains(kSimulated) || !holds_together(run)) {
    throw base::InputError({.value = "it was changed since it was written"});
  }
  run.simulated = json.at(kSimulated).dump();
  return run;
}

}  // namespace repose::calibrate
