#include "cli/simulate/simulate_output.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/version.h"
#include "calibrate/experiment/model_fields.h"
#include "calibrate/measured/json_text.h"
#include "cli/common/table.h"
#include "cli/simulate/simulate_summary.h"
#include "dem/contact/model_names.h"
#include "dem/experiment/experiment_table.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {
namespace {

using calibrate::Json;

constexpr int kNoteIndent = 2;
constexpr double kMillimetres = 1e3;

std::string text_of(const Json& json) {
  // File names need not be UTF-8, but JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// JSON has no NaN: missing numbers are null.
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
          {"size_sd_percent", 100 * plan.spec.model.size_cv}};
}

/// Null: our own engine.
Json engine_json(const calibrate::RunSpec& spec) {
  if (spec.simulator->title().empty()) return nullptr;
  return {{"name", spec.simulator->title()}, {"differences", spec.simulator->differences(spec)}};
}

/// The conditions that a value depends on, except seed and time step.
void add_context(const SimulatePlan& plan, Json& json) {
  const dem::Model& model = plan.spec.model;
  json["engine"] = engine_json(plan.spec);
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

/// A heap's angle from both sources, and each of its views.
void add_pictures(const calibrate::RunResult& run, Json& json) {
  const auto seen = calibrate::picture_mean(run).angle_deg;
  json["source"] = calibrate::is_from_pictures(run) ? "pictures" : "positions";
  json["angle_from_pictures_deg"] = seen ? finite_or_null(seen->mean) : Json(nullptr);
  json["sd_between_views_deg"] = seen ? finite_value_or_null(seen->sd) : Json(nullptr);
  json["angle_from_positions_deg"] = finite_value_or_null(calibrate::position_value(run));
  json["views"] = Json::array();
  for (const calibrate::HeapView& view : run.views) {
    const auto angle = calibrate::angle_by(view.picture, run.definition);
    json["views"].push_back({{"azimuth_deg", rounded_degrees(view.azimuth_rad)},
                             {"status", name_of(view.picture.status)},
                             {"angle_deg", angle ? Json(rounded_degrees(*angle)) : Json(nullptr)}});
  }
}

/// The same for all repeats together, and the directions they were seen from.
void add_sources(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs,
                 Json& json) {
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

Json run_json(const calibrate::RunResult& run, const RunFiles& files) {
  Json readings = Json::object();
  for (const auto& [name, value] : run.readings) readings[name] = finite_value_or_null(value);
  Json json{{"seed", run.seed},
            {"value", finite_value_or_null(calibrate::value_of(run))},
            {"reason", run.failure.empty() ? Json(nullptr) : Json(run.failure)},
            {"wall_s", run.wall_s},
            {"steps", run.steps},
            {"clump_steps_per_s", finite_or_null(run.clump_steps / run.wall_s)},
            {"timestep_s", run.timestep_s},
            {"state", files.state.empty() ? Json(nullptr) : Json(files.state)},
            {"overlay", files.overlay.empty() ? Json(nullptr) : Json(files.overlay)},
            {"readings", readings}};
  if (!run.views.empty()) add_pictures(run, json);
  const auto definitions = calibrate::values_by_definition(run);
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

std::string unit_sign(const SimulatePlan& plan) {
  const std::string_view unit = plan.experiment->unit;
  return unit == "deg" ? "°" : fmt::format(" {}", unit);
}

Table repeats_table(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs) {
  constexpr double kMicroseconds = 1e6, kMillion = 1e6;
  const bool is_mixed = source_of(runs) == "mixed";
  Table table({number_column("seed"),
               number_column(fmt::format("value [{}]", plan.experiment->unit)),
               number_column("steps"),
               number_column("step [us]"),
               number_column("time [s]"),
               number_column("Mclump-st/s"),
               {}});
  for (const calibrate::RunResult& run : runs) {
    const auto value = calibrate::value_of(run);
    table.add_row({std::to_string(run.seed), value ? fmt::format("{:.3f}", *value) : kMissing,
                   std::to_string(run.steps), fmt::format("{:.3f}", run.timestep_s * kMicroseconds),
                   fmt::format("{:.1f}", run.wall_s),
                   fmt::format("{:.3f}", run.clump_steps / run.wall_s / kMillion),
                   is_mixed && !calibrate::is_from_pictures(run) ? "from positions" : ""});
  }
  return table;
}

std::string mean_text(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs) {
  const auto summary = summarise(runs);
  const std::string unit = unit_sign(plan);
  if (!summary) return "no mean: a repeat gave no number";
  if (!summary->sd && summary->n > 1) {
    return fmt::format("mean {:.3f}{} n = {}, all identical: no scatter and no interval",
                       summary->mean, unit, summary->n);
  }
  if (!summary->sd || !summary->mean_uncertainty) {
    return fmt::format(
        "mean {:.3f}{} Only one repeat: no standard deviation or interval. Try --repeats 5",
        summary->mean, unit);
  }
  return fmt::format(
      "mean {:.3f}{} sd {:.3f}{} n = {}, 95 % interval of the mean {:.3f} … {:.3f}{}"
      " (Student)",
      summary->mean, unit, *summary->sd, unit, summary->n,
      summary->mean - *summary->mean_uncertainty, summary->mean + *summary->mean_uncertainty, unit);
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : kMissing;
}

/// A heap's angle from its pictures and from the positions of its grains.
void add_sources_table(const std::vector<calibrate::RunResult>& runs, Page& page) {
  const auto angles = heap_angles(runs);
  if (!angles) return;
  Table table({{.heading = "  angle [deg]"},
               number_column("mean"),
               number_column("sd of repeats"),
               number_column("sd of views"),
               {}});
  const auto add = [&](const char* source, const std::optional<calibrate::Summary>& repeats,
                       const std::optional<double>& between_views, std::size_t count) {
    const std::string mean = repeats ? cell(repeats->mean) : kMissing;
    const std::string sd = repeats ? cell(repeats->sd) : kMissing;
    const std::string use = count == 0             ? ""
                            : count == runs.size() ? "the value"
                                                   : fmt::format("the value of {}", count);
    table.add_row({source, mean, sd, cell(between_views), use});
  };
  const auto pictured = static_cast<std::size_t>(angles->pictured);
  add("  pictures", angles->pictures, angles->between_views_pictures, pictured);
  add("  positions", angles->positions, angles->between_views_positions, runs.size() - pictured);
  table.add_note("  ", fmt::format("{} {}: {} refused, {} flagged", angles->views,
                                   angles->views == 1 ? "picture" : "pictures", angles->refused,
                                   angles->flagged));
  page.add_gap();
  page.add(table);
}

/// The mean by each definition of the angle, and which of them is the value.
void add_definitions_table(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs,
                           Page& page) {
  const auto means = calibrate::means_by_definition(runs);
  if (means.empty()) return;
  Table table({{.heading = "  definition of the angle"}, number_column("mean [deg]"), {}, {}});
  for (const auto& [name, mean] : means) {
    const bool is_value = name == base::definition_meant(plan.spec.definition);
    table.add_row({"  " + name, fmt::format("{:.2f}", mean), is_value ? "the value" : "",
                   std::string(base::find_definition(name)->description)});
  }
  page.add_gap();
  page.add(table);
}

/// "measured 9.420 mm, n = 10; simulated - measured = -0.290 mm (-3.1 %)"
std::string measured_text(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs) {
  const dem::Measured& measured = dem::measured_in(plan.study, plan.experiment);
  if (!measured.pictures.empty()) {
    return "measured in pictures: repose measure gives their angle\n";
  }
  if (!measured.scans.empty()) {
    return "measured in scans: repose calibrate reads their angle in silhouettes\n";
  }
  if (!measured.videos.empty()) {
    return fmt::format("measured in films: repose track {} gives their readings\n",
                       dem::name_of(plan.experiment));
  }
  std::optional<double> mean = measured.mean, sd = measured.sd;
  std::optional<int> n = measured.count;
  if (!measured.values.empty()) {
    const calibrate::Summary repeats = calibrate::summarise(measured.values);
    mean = repeats.mean;
    sd = repeats.sd;
    n = repeats.n;
  }
  if (!mean) return {};
  const std::string unit = unit_sign(plan);
  std::string text = fmt::format("measured {:.3f}{}", *mean, unit);
  if (sd) text += fmt::format(" sd {:.3f}{}", *sd, unit);
  if (n) text += fmt::format(" n = {}", *n);
  if (plan.mean_without_air) {
    mean = plan.mean_without_air;
    text += fmt::format(", {:.3f}{} without the drag of the air", *mean, unit);
  }
  if (const auto summary = summarise(runs)) {
    const double difference = summary->mean - *mean;
    text += fmt::format("; simulated - measured = {:+.3f}{}", difference, unit);
    if (*mean != 0) text += fmt::format(" ({:+.1f} %)", 100 * difference / *mean);
  }
  return text;
}

/// "(20.1 … 23.4)", and the number of repeats if not all have it.
std::string range_text(const std::vector<double>& values, std::size_t repeats) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  std::string text;
  if (values.size() > 1) text = fmt::format("({:.4g} … {:.4g})", *least, *greatest);
  if (values.size() == repeats) return text;
  return text + fmt::format("{}of {} of {}", text.empty() ? "" : " ", values.size(), repeats);
}

/// The mean of each other reading over the repeats that have it.
void add_readings(const std::vector<calibrate::RunResult>& runs, Page& page) {
  std::set<std::string> names;
  for (const calibrate::RunResult& run : runs) {
    for (const auto& [name, value] : run.readings) names.insert(name);
  }
  if (names.empty()) return;
  Table table({{}, {}, {}});
  for (const std::string& name : names) {
    const std::vector<double> values = readings_named(runs, name);
    if (values.empty()) {
      table.add_row({"  " + name, kMissing, ""});
      continue;
    }
    table.add_row({"  " + name, fmt::format("{:.4g}", calibrate::summarise(values).mean),
                   range_text(values, runs.size())});
  }
  page.add_gap();
  page.add("other readings");
  page.add(table);
}

std::string coefficients_text(const dem::PairCoefficients& pair) {
  const std::string by_speed =
      pair.restitution_exponent == 0
          ? ""
          : fmt::format(" at {:g} m/s, falling with the speed to the power {:g}",
                        pair.restitution_speed_m_s, pair.restitution_exponent);
  return fmt::format("restitution {:g}{}, sliding friction {:g}, rolling friction {:g}",
                     pair.restitution, by_speed, pair.sliding_friction, pair.rolling_friction);
}

/// Coefficients are meaningless without these.
Table belongs_to_table(const SimulatePlan& plan) {
  const dem::Model& model = plan.spec.model;
  const bool is_own = plan.spec.simulator->title().empty();
  const std::string step =
      !is_own            ? std::string("half of our longest accurate one")
      : model.timestep_s ? fmt::format("{:g} s, as requested", *model.timestep_s)
                         : fmt::format("{:g} of the longest accurate one", model.timestep_fraction);
  Table table({{}, {}});
  if (const std::string engine = plan.spec.simulator->title(); !engine.empty()) {
    table.add_row({"  engine", engine});
    for (const std::string& difference : plan.spec.simulator->differences(plan.spec)) {
      table.add_row({"  other than ours", difference});
    }
  }
  table.add_row({"  contact model", std::string(dem::kContactModel)});
  table.add_row({"  rolling model", fmt::format("{}: {}", dem::name_of(model.rolling),
                                                dem::rolling_definition(model.rolling))});
  table.add_row({"  damping", fmt::format("{}: {}", dem::name_of(model.damping),
                                          dem::damping_definition(model.damping))});
  table.add_row(
      {"  clump", fmt::format("{} sphere{}, volume error {:.1f} % ({})", model.grain.spheres.size(),
                              model.grain.spheres.size() == 1 ? "" : "s",
                              100 * plan.grain.errors.volume_error, plan.grain.source)});
  if (model.size_cv > 0) {
    table.add_row(
        {"  sizes", fmt::format("standard deviation {:.3g} % of the mean", 100 * model.size_cv)});
  }
  table.add_row({"  stiffness factor", fmt::format("{:g}", model.stiffness_factor)});
  table.add_row({"  time step", step});
  if (const auto& camera = plan.spec.viewing.camera) {
    table.add_row(
        {"  camera", fmt::format("{:g} mm from the heap's middle, {:g} mm above the plate",
                                 1000 * camera->distance_m, 1000 * camera->height_m)});
  }
  table.add_row({"  with the wall", coefficients_text(model.grain_wall)});
  for (const auto& [part, surface] : model.parts) {
    table.add_row({"  with the " + name_of(part), coefficients_text(surface.with_grain)});
  }
  if (dem::has_grain_contacts(plan.experiment)) {
    table.add_row({"  between grains", coefficients_text(model.grain_grain)});
  }
  return table;
}

}  // namespace

std::string simulate_json(const SimulatePlan& plan, const Repeats& repeats) {
  const std::vector<calibrate::RunResult>& runs = repeats.runs;
  const dem::ExperimentEntry& entry = *plan.experiment;
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
    json["definitions_deg"] = object_of(calibrate::means_by_definition(runs));
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    json["repeats"].push_back(run_json(runs[k], repeats.files[k]));
  }
  json["warnings"] = Json::array();
  // Already printed when the run began.
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

std::string simulate_table(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs,
                           int columns) {
  const dem::ExperimentEntry& entry = *plan.experiment;
  Page page(columns);
  page.add(fmt::format("{}: {}", entry.name, entry.value_name));
  page.add(repeats_table(plan, runs));
  page.add_gap();
  page.add(mean_text(plan, runs));
  page.add(measured_text(plan, runs));
  add_sources_table(runs, page);
  add_definitions_table(plan, runs, page);
  add_readings(runs, page);
  page.add_gap();
  page.add("these values are valid for");
  page.add(belongs_to_table(plan));
  return page.text();
}

}  // namespace repose::cli
