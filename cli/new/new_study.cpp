#include "cli/new/new_study.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/start/new_request.h"
#include "calibrate/start/new_study.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {

namespace {

/// What `repose new` will write.
struct NewPlan {
  calibrate::NewRequest request;
  calibrate::NewStudy study;
  std::vector<std::string> errors;  ///< empty: it can be carried out
};

template <typename Kind>
std::vector<std::string> names_of(std::span<const Kind> kinds) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

/// "50x150": inner diameter and height.
std::optional<std::array<double, 2>> read_tube(const OptionText& typed) {
  if (typed.text.empty()) return std::nullopt;
  const std::size_t cross = typed.text.find('x');
  const auto diameter = parse_number<double>(std::string_view(typed.text).substr(0, cross));
  const auto height = cross == std::string::npos
                          ? std::nullopt
                          : parse_number<double>(std::string_view(typed.text).substr(cross + 1));
  if (diameter && height) return std::array{*diameter, *height};
  typed.refuse("inner diameter and height with an x between them, both more than 0",
               "--tube-mm 50x150");
  return std::nullopt;
}

/// "A,B".
std::vector<std::string> words_in(const std::string& typed) {
  std::vector<std::string> words;
  std::istringstream stream(typed);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

NewPlan plan_new(const NewArguments& arguments) {
  NewPlan plan{.request = {.study = arguments.study,
                           .grains = arguments.grains,
                           .plate = arguments.plate,
                           .parts = {{dem::WallPart::tube, arguments.tube},
                                     {dem::WallPart::incline, arguments.incline},
                                     {dem::WallPart::pane, arguments.pane}},
                           .experiments = words_in(arguments.experiments)},
               .study = {},
               .errors = {}};
  const OptionText sizes{"--grain-mm", arguments.grain_mm, plan.errors};
  plan.request.grain_mm = numbers_in<double, 3>(arguments.grain_mm);
  if (!plan.request.grain_mm && !arguments.grain_mm.empty()) {
    sizes.refuse("length, width and thickness, with commas between them", "--grain-mm 7.6,6.9,6.2");
  }
  plan.request.density_kg_m3 =
      read_number({"--density-kg-m3", arguments.density_kg_m3, plan.errors}, "a number of kg/m3",
                  "--density-kg-m3 1200");
  plan.request.tube_mm = read_tube({"--tube-mm", arguments.tube_mm, plan.errors});
  const calibrate::RequestedStudy made = calibrate::requested_study(plan.request);
  for (const base::Fault& fault : made.faults) {
    plan.errors.push_back(fault.text(calibrate::kNewFields));
  }
  plan.study = made.study;
  return plan;
}

std::string assumed_text(const calibrate::NewStudy& study) {
  std::vector<std::string> texts;
  for (const auto& [text, field] : calibrate::assumptions_of(study)) {
    const auto* const found =
        std::ranges::find(calibrate::kNewFields, field, &base::FieldName::field);
    texts.push_back(
        found == calibrate::kNewFields.end() ? text : fmt::format("{} ({})", text, found->option));
  }
  return fmt::format("Assumed, to be replaced by your own: {}.", fmt::join(texts, ", "));
}

std::string page_of(const NewPlan& plan, int columns) {
  const calibrate::NewStudy& study = plan.study;
  const std::filesystem::path folder = calibrate::sheet_folder_of(plan.request.study);
  Page page(columns);
  page.add(fmt::format("Wrote {}: {}.", plan.request.study.string(), calibrate::title_of(study)));
  page.add_gap();
  Table table({{.heading = "sheet"}, {.heading = "measures"}, {.heading = "columns"}});
  for (const calibrate::NewSheet& sheet : calibrate::sheets_of(study)) {
    table.add_row({(folder / sheet.name).string(), std::string(sheet.experiment->value_name),
                   fmt::format("{}", fmt::join(sheet.columns, ", "))});
  }
  page.add(table);
  page.add_gap();
  page.add(assumed_text(study));
  page.add_gap();
  if (const auto sticky = calibrate::sticking_of(study)) {
    page.add("! ", *sticky);
    page.add_gap();
  }
  page.add("Next:");
  page.add("  1. ",
           fmt::format("fill in the sheets, one row per reading, at least ten readings each; "
                       "delete from {} the experiments that you cannot do",
                       plan.request.study.string()));
  page.add("  2. ", fmt::format("repose calibrate {} --dry-run, to see how long it will take",
                                plan.request.study.string()));
  page.add("  3. ", fmt::format("repose calibrate {}", plan.request.study.string()));
  page.add("  4. ",
           fmt::format("repose report {}_calibration", plan.request.study.stem().string()));
  return page.text();
}

}  // namespace

ExitCode run_new(const NewArguments& arguments) {
  const NewPlan plan = plan_new(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  calibrate::write_new_study(plan.study, plan.request.study);
  Outputs outputs;
  outputs.show(page_of(plan, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

namespace {

constexpr const char* kNewNotes = R"(
Writes a commented study file and, in a folder of the same name beside it, a
CSV sheet for each experiment to fill in at the bench: soybean.toml and
soybean/drops.csv, tilts.csv, rolls.csv, heaps.csv. Values not given are typical
of the grain, and marked as assumed in the file. Existing files are never
overwritten.

KIND of grain: soybean, maize, wheat, rice, hazelnut, pea, rapeseed, glass
(beads), other. KIND of plate, tube, incline, pane (the upright walls of a
draw-down): acrylic, steel, aluminium, glass, pvc, wood, rubber. Bounds of the
coefficients are from the literature on that grain where there is any, otherwise
wide.

Examples:
  repose new my_grain.toml
  repose new soybean.toml --grains soybean --plate acrylic \
    --grain-mm 7.6,6.9,6.2 --tube-mm 50x150
)";

/// Includes the default ones, as typed.
std::string experiments_help() {
  std::vector<std::string_view> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    if (entry.is_default) names.push_back(entry.name);
  }
  return fmt::format("Of the experiments ({})", fmt::join(names, ","));
}

}  // namespace

Command new_command() {
  const auto given = std::make_shared<NewArguments>();
  return {
      .name = "new",
      .summary = "Start a study: its file and sheets to fill in",
      .options = {{"study", "STUDY.toml", "Study file to write", &given->study, true},
                  {.name = "--grains",
                   .value_name = "KIND",
                   .help = "Kind of grain (other)",
                   .target = &given->grains,
                   .words = names_of(calibrate::grain_kinds())},
                  {"--grain-mm", "L,W,T", "Length, width, thickness (typical)", &given->grain_mm},
                  {"--density-kg-m3", "D", "Density of a grain (typical)", &given->density_kg_m3},
                  {.name = "--plate",
                   .value_name = "KIND",
                   .help = "Material of the plate (steel)",
                   .target = &given->plate,
                   .words = names_of(calibrate::plate_kinds())},
                  {.name = "--tube",
                   .value_name = "KIND",
                   .help = "Material of the tube (as the plate)",
                   .target = &given->tube,
                   .words = names_of(calibrate::plate_kinds())},
                  {.name = "--incline",
                   .value_name = "KIND",
                   .help = "Material of the incline (as the plate)",
                   .target = &given->incline,
                   .words = names_of(calibrate::plate_kinds())},
                  {.name = "--pane",
                   .value_name = "KIND",
                   .help = "Material of a box's walls (as the plate)",
                   .target = &given->pane,
                   .words = names_of(calibrate::plate_kinds())},
                  {"--tube-mm", "DxH", "Inner diameter and height (from grain size)",
                   &given->tube_mm},
                  {"--experiments", "A,B,...", experiments_help(), &given->experiments}},
      .notes = kNewNotes,
      .missing = "no study file given. Fix: repose new my_study.toml.",
      .run = [given] { return run_new(*given); }};
}

}  // namespace repose::cli
