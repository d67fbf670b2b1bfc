#include "cli/new/new_study.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/units.h"
#include "cli/common/output.h"
#include "cli/common/page.h"
#include "cli/common/terminal.h"
#include "cli/new/new_options.h"
#include "dem/contact/adhesion.h"
#include "dem/study/experiment_table.h"

namespace repose::cli {
namespace {

/// What is not measured yet, and stands in the study all the same.
std::string assumptions_of(const calibrate::NewStudy& study) {
  std::string text = "Assumed, to be replaced by your own:";
  if (!study.has_own_sizes) {
    text += fmt::format(" grains of {:g} mm (--grain-mm),", fmt::join(study.sizes_mm, " x "));
  }
  if (!study.has_own_density) {
    text += fmt::format(" {:g} kg/m³ (--density-kg-m3),", study.density_kg_m3);
  }
  if (!study.has_own_tube && makes_heaps(study)) {
    text += fmt::format(" a tube of {:g} x {:g} mm (--tube-mm),", study.tube_diameter_mm,
                        study.tube_height_mm);
  }
  if (!study.parts.empty()) {
    std::vector<std::string> parts;
    for (const auto& [part, plate] : study.parts) parts.push_back(name_of(part));
    text += fmt::format(" the coefficients of {},", fmt::join(parts, " and "));
  }
  return text + " the stiffness of grains and plate.";
}

std::string page_of(const NewPlan& plan, int columns) {
  const calibrate::NewStudy& study = plan.study;
  const std::filesystem::path folder = calibrate::sheet_folder_of(plan.file);
  Page page(columns);
  page.add(fmt::format("Wrote {}: {}.", plan.file.string(), calibrate::title_of(study)));
  page.add_gap();
  Table table({{.heading = "sheet"}, {.heading = "measures"}, {.heading = "columns"}});
  for (const calibrate::NewSheet& sheet : calibrate::sheets_of(study)) {
    table.add_row({(folder / sheet.name).string(),
                   std::string(dem::entry_of(sheet.experiment).value_name),
                   fmt::format("{}", fmt::join(sheet.columns, ", "))});
  }
  page.add(table);
  page.add_gap();
  page.add(assumptions_of(study));
  page.add_gap();
  const auto& [length_mm, width_mm, thickness_mm] = study.sizes_mm;
  const double volume_m3 =
      std::numbers::pi / 6 * length_mm * width_mm * thickness_mm * std::pow(kMPerMm, 3);
  if (const auto sticky = dem::adhesion_warning(volume_m3, study.density_kg_m3)) {
    page.add("! ", *sticky + '.');
    page.add_gap();
  }
  page.add("Next:");
  page.add("  1. ",
           fmt::format("fill in the sheets, one row per reading, at least ten readings each; "
                       "delete from {} the experiments that you cannot do",
                       plan.file.string()));
  page.add("  2. ", fmt::format("repose calibrate {} --dry-run, to see how long it will take",
                                plan.file.string()));
  page.add("  3. ", fmt::format("repose calibrate {}", plan.file.string()));
  page.add("  4. ", fmt::format("repose report {}_calibration", plan.file.stem().string()));
  return page.text();
}

}  // namespace

ExitCode run_new(const NewArguments& arguments) {
  const NewPlan plan = plan_new(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  calibrate::write_new_study(plan.study, plan.file);
  Outputs outputs;
  outputs.show(page_of(plan, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
