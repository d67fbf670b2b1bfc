#include "cli/shape/shape.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/shape/shape_options.h"
#include "cli/shape/shape_report.h"
#include "dem/shape/clump/clump_file.h"

namespace repose::cli {
namespace {

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

}  // namespace repose::cli
