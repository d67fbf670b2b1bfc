#include "cli/shape/shape_options.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "cli/common/number.h"
#include "cli/common/output_places.h"

namespace repose::cli {
namespace {

void read_sizes(const ShapeArguments& arguments, ShapePlan& plan) {
  const auto sizes = numbers_in<double, 3>(arguments.size_mm);
  if (!sizes || *std::min_element(sizes->begin(), sizes->end()) <= 0) {
    plan.errors.push_back(fmt::format(
        "--size-mm {}: must be length, width and thickness above 0, with commas between "
        "them. Fix: --size-mm 22.48,18.23,17.46.",
        arguments.size_mm));
    return;
  }
  const auto [length_mm, width_mm, thickness_mm] = *sizes;
  plan.sizes = {
      .length_m = length_mm / 1e3, .width_m = width_mm / 1e3, .thickness_m = thickness_mm / 1e3};
  if (arguments.tip.empty()) return;
  const auto tip = number_in<double>(arguments.tip);
  if (!tip || *tip < 0 || *tip > 1) {
    plan.errors.push_back(fmt::format(
        "--tip {}: must be a number from 0 (round) to 1 (pointed). Fix: a hazelnut is about 0.5.",
        arguments.tip));
    return;
  }
  plan.sizes->tip_fraction = *tip;
}

void read_unit(const std::string& text, ShapePlan& plan) {
  if (text.empty() || text == "mm") return;
  if (text == "m") {
    plan.unit = dem::ScanUnit::metre;
    return;
  }
  plan.errors.push_back(fmt::format("--unit {}: is none that is known here. Fix: mm or m.", text));
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
    read_unit(arguments.unit, plan);
  }
}

void read_fill(const ShapeArguments& arguments, ShapePlan& plan) {
  if (!arguments.spheres.empty() && !arguments.volume_error.empty()) {
    plan.errors.emplace_back(
        "--spheres and --volume-error: each sets how many spheres. Fix: leave one of them out.");
  }
  if (!arguments.spheres.empty()) {
    const auto spheres = number_in<int>(arguments.spheres);
    if (!spheres || *spheres < 1 || *spheres > dem::kMaxSpheres) {
      plan.errors.push_back(
          fmt::format("--spheres {}: must be a whole number from 1 to {}. Fix: 11 is usual.",
                      arguments.spheres, dem::kMaxSpheres));
    } else {
      plan.fill.spheres = *spheres;
    }
  }
  if (arguments.volume_error.empty()) return;
  std::string_view text = arguments.volume_error;
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.remove_suffix(1);
  const auto number = number_in<double>(text);
  const double fraction = number.value_or(0) / (is_percent ? 100 : 1);
  if (!(fraction > 0 && fraction < 1)) {
    plan.errors.push_back(
        fmt::format("--volume-error {}: must be a share between 0 and 1, or a percentage with its "
                    "sign. Fix: 0.02 or 2%.",
                    arguments.volume_error));
    return;
  }
  plan.fill.volume_error = fraction;
}

void read_density(const std::string& text, ShapePlan& plan) {
  if (text.empty()) return;
  constexpr double kLightest = 10, kHeaviest = 25000;  // foam, osmium; g/cm3 lie below
  const auto density = number_in<double>(text);
  if (!density || *density < kLightest || *density > kHeaviest) {
    plan.errors.push_back(
        fmt::format("--density-kg-m3 {}: must be a number from {} to {}. Fix: water is 1000; "
                    "multiply g/cm3 by 1000.",
                    text, kLightest, kHeaviest));
    return;
  }
  plan.density_kg_m3 = density;
}

void read_mesh_format(const std::string& file, ShapePlan& plan) {
  if (file.empty()) return;
  if (file.ends_with(".stl")) {
    plan.mesh_format = dem::ShapeFormat::stl;
  } else if (!file.ends_with(".glb")) {
    plan.errors.push_back(
        fmt::format("--mesh {}: its ending must say what it is. Fix: .glb or .stl.", file));
  }
}

}  // namespace

ShapePlan plan_shape(const ShapeArguments& arguments) {
  ShapePlan plan;
  read_grain(arguments, plan);
  read_fill(arguments, plan);
  read_density(arguments.density_kg_m3, plan);
  read_mesh_format(arguments.mesh_file, plan);
  check_output_places({{"--out", arguments.out_file},
                       {"--mesh", arguments.mesh_file},
                       {"--json", arguments.json_file}},
                      {arguments.scan}, plan.errors);
  return plan;
}

}  // namespace repose::cli
