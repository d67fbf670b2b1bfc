#include "cli/shape/shape.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/units.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/shape/clump/fill.h"
#include "dem/shape/clump/shape_export.h"
#include "dem/shape/scan/calliper.h"
#include "dem/shape/scan/scan.h"

namespace repose::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMm2PerM2 = 1e6;

constexpr double kMm3PerM3 = 1e9;

constexpr double kGramPerKg = 1e3;

/// Extents along the principal axes.
dem::Vector size_mm(const dem::ClumpShape& shape) {
  dem::Vector low = shape.surface.vertices.front(), high = low;
  for (const dem::Vector& vertex : shape.surface.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return kMmPerM * (high - low);
}

double mass_g(const dem::ClumpShape& shape, double density_kg_m3) {
  return kGramPerKg * density_kg_m3 * shape.volume_m3;
}

dem::Vector gyration_mm2(const dem::ClumpShape& shape) { return kMm2PerM2 * shape.gyration_m2; }

void add_mass(const dem::ClumpShape& shape, std::optional<double> density_kg_m3, Table& table) {
  const dem::Vector gyration = gyration_mm2(shape);
  if (!density_kg_m3) {
    table.add_row({"mass", fmt::format("{} (needs --density-kg-m3)", kMissing)});
    table.add_row({"moments", fmt::format("{:.4g}, {:.4g}, {:.4g} mm² times the mass", gyration.x(),
                                          gyration.y(), gyration.z())});
    return;
  }
  const double mass = mass_g(shape, *density_kg_m3);
  const dem::Vector moments = mass * gyration;
  table.add_row({"mass", fmt::format("{:.4g} g at {:g} kg/m³", mass, *density_kg_m3)});
  table.add_row({"moments", fmt::format("{:.4g}, {:.4g}, {:.4g} g mm²", moments.x(), moments.y(),
                                        moments.z())});
}

void add_spheres(const dem::ClumpFile& clump, Table& table) {
  const auto& spheres = clump.shape.spheres;
  const dem::ClumpErrors& errors = clump.errors;
  const auto [smallest, largest] =
      std::minmax_element(spheres.begin(), spheres.end(),
                          [](const auto& a, const auto& b) { return a.radius < b.radius; });
  table.add_row({"spheres", fmt::format("{}, radii {:.4g} … {:.4g} mm", spheres.size(),
                                        kMmPerM * smallest->radius, kMmPerM * largest->radius)});
  table.add_row(
      {"volume error", fmt::format("{:.2f} % missing or sticking out; in all {:+.2f} %",
                                   100 * errors.volume_error, 100 * errors.volume_difference)});
  table.add_row({"inertia error",
                 fmt::format("{:.2f} % of the spheres alone (a simulation uses the surface's own)",
                             100 * errors.inertia_error)});
  table.add_row({"surface error", fmt::format("{:.3g} mm on average, {:.3g} mm for 95 %",
                                              kMmPerM * errors.surface_error_mean_m,
                                              kMmPerM * errors.surface_error_p95_m)});
  table.add_row(
      {"farthest", fmt::format("{:.3g} mm outside the surface, {:.3g} mm inside it",
                               kMmPerM * errors.sticks_out_m, kMmPerM * errors.falls_short_m)});
}

Json vector_json(const dem::Vector& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json spheres_json(const dem::ClumpShape& shape) {
  Json spheres = Json::array();
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    spheres.push_back({{"x_mm", kMmPerM * sphere.centre.x()},
                       {"y_mm", kMmPerM * sphere.centre.y()},
                       {"z_mm", kMmPerM * sphere.centre.z()},
                       {"r_mm", kMmPerM * sphere.radius}});
  }
  return spheres;
}

Json warnings_json(const dem::ClumpFile& clump) {
  Json warnings = Json::array();
  const std::string shape = dem::warning_of_shape(clump);
  if (!shape.empty()) warnings.push_back({{"code", "shape"}, {"message", shape}});
  return warnings;
}

/// The table for people.
std::string shape_table(const dem::ClumpFile& clump, std::optional<double> density_kg_m3,
                        int columns) {
  const dem::ClumpShape& shape = clump.shape;
  const dem::Vector size = size_mm(shape);
  Table table({{.heading = ""}, {.heading = ""}});
  table.add_row({"grain", clump.source});
  table.add_row({"size", fmt::format("{:.4g} × {:.4g} × {:.4g} mm along the principal axes",
                                     size.x(), size.y(), size.z())});
  table.add_row({"surface", fmt::format("{} triangles, closed", shape.surface.triangles.size())});
  table.add_row({"volume", fmt::format("{:.5g} mm³", kMm3PerM3 * shape.volume_m3)});
  add_mass(shape, density_kg_m3, table);
  add_spheres(clump, table);
  for (const std::string& repair : clump.repairs) table.add_row({"repaired", repair});
  return table.text(columns);
}

/// Everything, for programs.
std::string shape_json(const dem::ClumpFile& clump, std::optional<double> density_kg_m3) {
  const dem::ClumpShape& shape = clump.shape;
  const dem::ClumpErrors& errors = clump.errors;
  Json mass = nullptr, moments = nullptr, density = nullptr;
  if (density_kg_m3) {
    density = *density_kg_m3;
    mass = mass_g(shape, *density_kg_m3);
    moments = vector_json(mass_g(shape, *density_kg_m3) * gyration_mm2(shape));
  }
  const Json json{{"source", clump.source},
                  {"size_mm", vector_json(size_mm(shape))},
                  {"triangles", shape.surface.triangles.size()},
                  {"volume_mm3", kMm3PerM3 * shape.volume_m3},
                  {"density_kg_m3", density},
                  {"mass_g", mass},
                  {"moments_g_mm2", moments},
                  {"gyration_mm2", vector_json(gyration_mm2(shape))},
                  {"spheres", spheres_json(shape)},
                  {"volume_error", errors.volume_error},
                  {"volume_difference", errors.volume_difference},
                  {"inertia_error", errors.inertia_error},
                  {"surface_error_mean_mm", kMmPerM * errors.surface_error_mean_m},
                  {"surface_error_p95_mm", kMmPerM * errors.surface_error_p95_m},
                  {"sticks_out_mm", kMmPerM * errors.sticks_out_m},
                  {"falls_short_mm", kMmPerM * errors.falls_short_m},
                  {"repairs", clump.repairs},
                  {"warnings", warnings_json(clump)}};
  constexpr int kNoteIndent = 2;
  // File names need not be UTF-8, but JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Maps the fields named in library errors to options.
inline constexpr std::array<base::FieldName, 6> kShapeFields{
    {{"size", "--size-mm"},
     {"tip", "--tip"},
     {"volume error", "--volume-error"},
     {"its unit", "--unit"},
     {"more spheres", "--spheres"},
     {"smaller volume error", "--volume-error"}}};

/// A parsed `repose shape` command.
struct ShapePlan {
  std::optional<dem::CalliperSizes> sizes;  ///< std::nullopt: a scan is read
  dem::ScanUnit unit = dem::ScanUnit::millimetre;
  dem::FillOptions fill;
  std::optional<double> density_kg_m3;
  dem::ShapeFormat mesh_format = dem::ShapeFormat::glb;
  std::vector<std::string> errors;  ///< all errors; empty: it can be carried out
};

void add_problems(const std::vector<base::Fault>& problems, ShapePlan& plan) {
  for (const base::Fault& problem : problems) plan.errors.push_back(problem.text(kShapeFields));
}

void read_sizes(const ShapeArguments& arguments, ShapePlan& plan) {
  const auto sizes_mm = numbers_in<double, 3>(arguments.size_mm);
  if (!sizes_mm) {
    const OptionText typed{"--size-mm", arguments.size_mm, plan.errors};
    typed.refuse("length, width and thickness, with commas between them",
                 "--size-mm 22.48,18.23,17.46");
    return;
  }
  const auto [length_mm, width_mm, thickness_mm] = *sizes_mm;
  plan.sizes = {
      .length_m = length_mm / 1e3, .width_m = width_mm / 1e3, .thickness_m = thickness_mm / 1e3};
  const auto tip = read_number({"--tip", arguments.tip, plan.errors},
                               "a number from 0 (round) to 1 (pointed)", "a hazelnut is about 0.5");
  plan.sizes->tip_fraction = tip.value_or(plan.sizes->tip_fraction);
  add_problems(plan.sizes->problems(), plan);
}

void read_grain(const ShapeArguments& arguments, ShapePlan& plan) {
  if (arguments.scan.empty() == arguments.size_mm.empty()) {
    plan.errors.emplace_back(
        arguments.scan.empty()
            ? "shape: no grain is named. Fix: repose shape SCAN, or repose shape --size-mm L,W,T."
            : "shape: both a scan and --size-mm are given. Fix: leave one of them out.");
  }
  if (!arguments.size_mm.empty()) {
    read_sizes(arguments, plan);
  } else if (!arguments.tip.empty()) {
    plan.errors.emplace_back(
        "--tip: a scan has the tip that it has. Fix: leave --tip out, or use it with --size-mm.");
  }
  if (arguments.scan.empty() && !arguments.unit.empty()) {
    plan.errors.emplace_back("--unit: --size-mm is in mm. Fix: leave --unit out.");
  } else {
    plan.unit =
        read_choice<dem::ScanUnit>({"--unit", arguments.unit, plan.errors},
                                   {{"mm", dem::ScanUnit::millimetre}, {"m", dem::ScanUnit::metre}})
            .value_or(plan.unit);
  }
}

void read_fill(const ShapeArguments& arguments, ShapePlan& plan) {
  if (!arguments.spheres.empty() && !arguments.volume_error.empty()) {
    plan.errors.emplace_back(
        "--spheres and --volume-error: each sets how many spheres. Fix: leave one of them out.");
  }
  const auto spheres = read_whole_number({"--spheres", arguments.spheres, plan.errors}, 1,
                                         dem::kMaxSpheres, "11 is usual for a nut");
  plan.fill.spheres = spheres.value_or(plan.fill.spheres);
  if (arguments.volume_error.empty()) return;
  std::string_view text = arguments.volume_error;
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.remove_suffix(1);
  const auto number = parse_number<double>(text);
  if (!number) {
    const OptionText typed{"--volume-error", arguments.volume_error, plan.errors};
    typed.refuse("a fraction, or a percentage with its sign", "0.02 or 2%");
    return;
  }
  plan.fill.volume_error = *number / (is_percent ? 100 : 1);
  add_problems(plan.fill.problems(), plan);
}

ShapePlan plan_shape(const ShapeArguments& arguments) {
  ShapePlan plan;
  read_grain(arguments, plan);
  read_fill(arguments, plan);
  constexpr double kLightest = 10, kHeaviest = 25000;  // foam, osmium; g/cm3 lie below
  plan.density_kg_m3 =
      read_number_within({"--density-kg-m3", arguments.density_kg_m3, plan.errors}, kLightest,
                         kHeaviest, "water is 1000; multiply g/cm3 by 1000");
  plan.mesh_format = read_format<dem::ShapeFormat>(
                         {"--mesh", arguments.mesh_file, plan.errors},
                         {{".glb", dem::ShapeFormat::glb}, {".stl", dem::ShapeFormat::stl}})
                         .value_or(plan.mesh_format);
  check_output_places({json_place(arguments.out_file, "\"repose clump\"", "--out"),
                       {"--mesh", arguments.mesh_file, {}, kMeshMark},
                       json_place(arguments.json_file, "\"spheres\"")},
                      {arguments.scan}, plan.errors);
  return plan;
}

/// Grains shorter than this are rare, and scans in metres read as mm are common.
constexpr double kDoubtfulLength_m = 1e-3;

dem::Scan grain(const ShapeArguments& arguments, const ShapePlan& plan) {
  if (plan.sizes) return {.surface = dem::calliper_surface(*plan.sizes), .repairs = {}};
  return dem::read_scan(arguments.scan, plan.unit);
}

std::string source_of(const ShapeArguments& arguments) {
  if (!arguments.scan.empty()) return arguments.scan;
  return fmt::format("{} mm, tip {}", arguments.size_mm,
                     arguments.tip.empty() ? "0" : arguments.tip);
}

void warn_of_unit(const ShapeArguments& arguments, const dem::ClumpShape& shape) {
  if (arguments.scan.empty() || !arguments.unit.empty()) return;
  const double reach = shape.reach_m();
  if (2 * reach >= kDoubtfulLength_m) return;
  print_line(
      fmt::format("{}: is about {:.2g} mm long, taken in mm. If the scan is in metres, pass "
                  "--unit m.",
                  arguments.scan, 2e3 * reach));
}

void write_results(const dem::ClumpFile& clump, const ShapeArguments& arguments,
                   const ShapePlan& plan) {
  Outputs outputs;
  outputs.add(arguments.out_file, dem::clump_json(clump));
  if (!arguments.mesh_file.empty()) {
    const auto content = dem::export_shape(clump.shape, plan.mesh_format);
    outputs.add(arguments.mesh_file,
                {reinterpret_cast<const char*>(content.data()), content.size()});
  }
  outputs.add(arguments.json_file, shape_json(clump, plan.density_kg_m3));
  outputs.show(shape_table(clump, plan.density_kg_m3, columns_of(stdout)));
  outputs.write();
}

}  // namespace

ExitCode run_shape(const ShapeArguments& arguments) {
  const ShapePlan plan = plan_shape(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;

  dem::Scan scan = grain(arguments, plan);
  dem::FilledClump filled = dem::clump_of(scan.surface, plan.fill);
  const dem::ClumpFile clump{.source = source_of(arguments),
                             .repairs = std::move(scan.repairs),
                             .shape = std::move(filled.shape),
                             .errors = filled.errors};
  warn_of_unit(arguments, clump.shape);
  const std::string shape = dem::warning_of_shape(clump);
  if (!shape.empty()) print_line(shape);
  write_results(clump, arguments, plan);
  return ExitCode::done;
}

namespace {

constexpr const char* kShapeNotes = R"(
Turns a scan (STL, OBJ, PLY) or calliper sizes into a clump: a rigid grain of
overlapping spheres for a discrete element program. Volume, mass and inertia
come from the surface, never from the spheres. Small defects of a scan are
repaired and listed; a scan with others is refused, with advice on fixing it.

Volume error: the volume missed by the spheres plus the volume sticking out, as
a fraction of the grain's volume.

Examples:
  repose shape nut.stl --spheres 11 --out nut.json --mesh nut.glb
  repose shape --size-mm 22.48,18.23,17.46 --tip .5 --density-kg-m3 851
)";

}  // namespace

Command shape_command() {
  const auto given = std::make_shared<ShapeArguments>();
  return {
      .name = "shape",
      .summary = "Make a clump of spheres from a scan or sizes",
      .options =
          {{"scan", "SCAN", "Surface of one grain", &given->scan},
           {"--size-mm", "L,W,T", "Length, width, thickness, without a scan", &given->size_mm},
           {"--tip", "FRACTION", "Pointedness of one end, 0 to 1 (0)", &given->tip},
           {"--unit", "mm|m", "Unit of the scan (mm)", &given->unit},
           {"--spheres", "N", "Number of spheres (11)", &given->spheres},
           {"--volume-error", "P%", "As many spheres as this error requires", &given->volume_error},
           {"--density-kg-m3", "D", "Density, to compute the mass", &given->density_kg_m3},
           {"--out", "FILE.json", "Clump file", &given->out_file},
           {"--mesh", "FILE.glb|FILE.stl", "Surface and spheres, for viewing", &given->mesh_file},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kShapeNotes,
      .fields = kShapeFields,
      .run = [given] { return run_shape(*given); }};
}

}  // namespace repose::cli
