#include "cli/simulate/simulate_table.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "cli/common/page.h"
#include "cli/simulate/simulate_json.h"
#include "cli/simulate/simulate_values.h"
#include "dem/contact/damping_name.h"
#include "dem/contact/rolling_name.h"

namespace repose::cli {
namespace {

std::string unit_sign(const SimulatePlan& plan) {
  const std::string_view unit = dem::entry_of(plan.experiment).unit;
  return unit == "deg" ? "°" : fmt::format(" {}", unit);
}

Table repeats_table(const SimulatePlan& plan, const std::vector<Run>& runs) {
  constexpr double kMicroseconds = 1e6, kMillion = 1e6;
  const bool is_mixed = source_of(runs) == "mixed";
  Table table({number_column("seed"),
               number_column(fmt::format("value [{}]", dem::entry_of(plan.experiment).unit)),
               number_column("steps"),
               number_column("step [us]"),
               number_column("time [s]"),
               number_column("Mclump-st/s"),
               {}});
  for (const Run& run : runs) {
    const calibrate::SimulatedRun& result = run.result;
    const auto value = calibrate::value_of(result);
    table.add_row({std::to_string(result.seed), value ? fmt::format("{:.3f}", *value) : kNothing,
                   std::to_string(result.steps),
                   fmt::format("{:.3f}", result.timestep_s * kMicroseconds),
                   fmt::format("{:.1f}", result.wall_s),
                   fmt::format("{:.3f}", result.clump_steps / result.wall_s / kMillion),
                   is_mixed && !calibrate::is_from_pictures(result) ? "from positions" : ""});
  }
  return table;
}

std::string mean_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
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
  return value ? fmt::format("{:.2f}", *value) : kNothing;
}

/// A heap's angle from its pictures and from where its grains lie.
void add_sources(const std::vector<Run>& runs, Page& page) {
  const auto angles = heap_angles(runs);
  if (!angles) return;
  Table table({{.heading = "  angle [deg]"},
               number_column("mean"),
               number_column("sd of repeats"),
               number_column("sd of views"),
               {}});
  const auto add = [&](const char* source, const std::optional<calibrate::Summary>& repeats,
                       const std::optional<double>& between_views, std::size_t count) {
    const std::string mean = repeats ? cell(repeats->mean) : kNothing;
    const std::string sd = repeats ? cell(repeats->sd) : kNothing;
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
void add_definitions(const SimulatePlan& plan, const std::vector<Run>& runs, Page& page) {
  const auto means = means_by_definition(runs);
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
std::string measured_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const dem::Measured& measured = dem::measured_in(plan.study, plan.experiment);
  if (!measured.pictures.empty()) {
    return "measured in pictures: repose measure gives their angle\n";
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

/// "(20.1 … 23.4)", and of how many repeats where not all have it.
std::string range_text(const std::vector<double>& values, std::size_t repeats) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  std::string text;
  if (values.size() > 1) text = fmt::format("({:.4g} … {:.4g})", *least, *greatest);
  if (values.size() == repeats) return text;
  return text + fmt::format("{}of {} of {}", text.empty() ? "" : " ", values.size(), repeats);
}

/// The mean of each other reading over the repeats that have it.
void add_readings(const std::vector<Run>& runs, Page& page) {
  std::set<std::string> names;
  for (const Run& run : runs) {
    for (const auto& [name, value] : run.result.readings) names.insert(name);
  }
  if (names.empty()) return;
  Table table({{}, {}, {}});
  for (const std::string& name : names) {
    const std::vector<double> values = readings_named(runs, name);
    if (values.empty()) {
      table.add_row({"  " + name, kNothing, ""});
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

/// Coefficients mean nothing without these.
Table belongs_to_table(const SimulatePlan& plan) {
  const dem::Model& model = plan.spec.model;
  const std::string step =
      model.timestep_s ? fmt::format("{:g} s, as requested", *model.timestep_s)
                       : fmt::format("{:g} of the longest accurate one", model.timestep_fraction);
  Table table({{}, {}});
  table.add_row({"  contact model", std::string(dem::kContactModel)});
  table.add_row({"  rolling model", fmt::format("{}: {}", dem::name_of(model.rolling),
                                                dem::rolling_definition(model.rolling))});
  table.add_row({"  damping", fmt::format("{}: {}", dem::name_of(model.damping),
                                          dem::damping_definition(model.damping))});
  table.add_row(
      {"  clump", fmt::format("{} sphere{}, volume error {:.1f} % ({})", model.grain.spheres.size(),
                              model.grain.spheres.size() == 1 ? "" : "s",
                              100 * plan.grain.errors.volume_error, plan.grain.source)});
  if (model.size_sd_fraction > 0) {
    table.add_row({"  sizes", fmt::format("standard deviation {:.3g} % of the mean",
                                          100 * model.size_sd_fraction)});
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

std::string simulate_table(const SimulatePlan& plan, const std::vector<Run>& runs, int columns) {
  const dem::ExperimentEntry& entry = dem::entry_of(plan.experiment);
  Page page(columns);
  page.add(fmt::format("{}: {}", entry.name, entry.value_name));
  page.add(repeats_table(plan, runs));
  page.add_gap();
  page.add(mean_text(plan, runs));
  page.add(measured_text(plan, runs));
  add_sources(runs, page);
  add_definitions(plan, runs, page);
  add_readings(runs, page);
  page.add_gap();
  page.add("these values are valid for");
  page.add(belongs_to_table(plan));
  return page.text();
}

}  // namespace repose::cli
