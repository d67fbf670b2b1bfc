#include "cli/shape/shape_options.h"

#include <array>
#include <string_view>

#include "cli/common/number.h"
#include "cli/common/option_value.h"
#include "cli/common/output_places.h"

namespace repose::cli {
namespace {

void add_problems(const std::vector<base::Fault>& problems, ShapePlan& plan) {
  for (const base::Fault& problem : problems) plan.errors.push_back(problem.text(kShapeFields));
}

void read_sizes(const ShapeArguments& arguments, ShapePlan& plan) {
  const auto sizes_mm = numbers_in<double, 3>(arguments.size_mm);
  if (!sizes_mm) {
    const Typed typed{"--size-mm", arguments.size_mm, plan.errors};
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
  const auto number = number_in<double>(text);
  if (!number) {
    const Typed typed{"--volume-error", arguments.volume_error, plan.errors};
    typed.refuse("a fraction, or a percentage with its sign", "0.02 or 2%");
    return;
  }
  plan.fill.volume_error = *number / (is_percent ? 100 : 1);
  add_problems(plan.fill.problems(), plan);
}

}  // namespace

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

}  // namespace repose::cli
