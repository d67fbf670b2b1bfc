#include "cli/new/new_study.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "base/text.h"
#include "base/units.h"
#include "calibrate/start/new_study.h"
#include "calibrate/start/usual_experiment.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/contact/adhesion.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/scan/calliper.h"

namespace repose::cli {

namespace {

/// What `repose new` will write.
struct NewPlan {
  std::filesystem::path file;
  calibrate::NewStudy study;
  std::vector<std::string> errors;  ///< empty: it can be carried out
};

constexpr std::array kNewFields{base::FieldName{"size", "--grain-mm"}};

constexpr const char* kUsualPlate = "steel";

constexpr double kMaxGrains = 100'000;  // of an experiment

template <typename Kind>
std::vector<std::string> names_of(std::span<const Kind> kinds) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

/// What may be typed after --grains, and after --plate and its like.
std::vector<std::string> grain_names() { return names_of(calibrate::grain_kinds()); }

std::vector<std::string> plate_names() { return names_of(calibrate::plate_kinds()); }

void read_kinds(const NewArguments& arguments, NewPlan& plan) {
  const std::vector<std::string> grains = grain_names(), plates = plate_names();
  const auto grain = read_word({"--grains", arguments.grains, plan.errors}, grains);
  plan.study.grain = calibrate::grain_kinds()[grain.value_or(grains.size() - 1)];
  const auto usual = std::find(plates.begin(), plates.end(), kUsualPlate) - plates.begin();
  const auto plate = read_word({"--plate", arguments.plate, plan.errors}, plates);
  plan.study.plate = calibrate::plate_kinds()[plate.value_or(static_cast<std::size_t>(usual))];
}

/// A material named for a part that no experiment has would be of no use.
void read_parts(const NewArguments& arguments, NewPlan& plan) {
  for (const auto& [part, option, typed] :
       {std::tuple(dem::WallPart::tube, "--tube", &arguments.tube),
        {dem::WallPart::incline, "--incline", &arguments.incline},
        {dem::WallPart::pane, "--pane", &arguments.pane}}) {
    const auto kind = read_word({option, *typed, plan.errors}, plate_names());
    if (!kind) continue;
    const calibrate::PlateKind& plate = calibrate::plate_kinds()[*kind];
    std::string those_with, is_there;
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
      if (std::ranges::find(entry.parts, part) == entry.parts.end()) continue;
      those_with += (those_with.empty() ? "" : " or ") + std::string(entry.name);
      const auto& chosen = plan.study.experiments;
      if (std::ranges::find(chosen, &entry) != chosen.end()) is_there = entry.name;
    }
    if (is_there.empty()) {
      plan.errors.push_back(
          fmt::format("{} {}: none of the experiments has one. Fix: leave it out, or add {} to "
                      "--experiments.",
                      option, *typed, those_with));
    } else if (plate.name != plan.study.plate.name) {
      plan.study.parts.emplace(part, plate);
    }
  }
}

void read_grain(const NewArguments& arguments, NewPlan& plan) {
  calibrate::NewStudy& study = plan.study;
  study.sizes_mm = study.grain.sizes;
  if (!arguments.grain_mm.empty()) {
    const auto sizes = numbers_in<double, 3>(arguments.grain_mm);
    const OptionText typed{"--grain-mm", arguments.grain_mm, plan.errors};
    if (sizes) {
      study.sizes_mm = *sizes;
      study.has_own_sizes = true;
    } else {
      typed.refuse("length, width and thickness, with commas between them",
                   "--grain-mm 7.6,6.9,6.2");
    }
  }
  const dem::CalliperSizes sizes{.length_m = study.sizes_mm[0] * kMPerMm,
                                 .width_m = study.sizes_mm[1] * kMPerMm,
                                 .thickness_m = study.sizes_mm[2] * kMPerMm};
  for (const base::Fault& problem : sizes.problems()) {
    plan.errors.push_back(problem.text(kNewFields));
  }
  constexpr double kLightest = 10, kHeaviest = 25000;  // foam, osmium; g/cm3 lie below
  const auto density =
      read_number_within({"--density-kg-m3", arguments.density_kg_m3, plan.errors}, kLightest,
                         kHeaviest, "water is 1000; multiply g/cm3 by 1000");
  study.has_own_density = density.has_value();
  study.density_kg_m3 = density.value_or(study.grain.density_kg_m3);
}

/// "50x150": inner diameter and height.
void read_tube(const NewArguments& arguments, NewPlan& plan) {
  calibrate::NewStudy& study = plan.study;
  study.tube_diameter_mm = calibrate::usual_tube_diameter_mm(study.sizes_mm);
  study.tube_height_mm = 3 * study.tube_diameter_mm;
  if (!arguments.tube_mm.empty()) {
    const std::string& text = arguments.tube_mm;
    const std::size_t cross = text.find('x');
    const auto diameter = parse_number<double>(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos
                            ? std::nullopt
                            : parse_number<double>(std::string_view(text).substr(cross + 1));
    if (!diameter || !height || *diameter <= 0 || *height <= 0) {
      const OptionText typed{"--tube-mm", text, plan.errors};
      typed.refuse("inner diameter and height with an x between them, both more than 0",
                   "--tube-mm 50x150");
      return;
    }
    study.tube_diameter_mm = *diameter;
    study.tube_height_mm = *height;
    study.has_own_tube = true;
  }
  const auto is_in_tube = [](const dem::ExperimentEntry& entry) {
    return std::ranges::find(entry.parts, dem::WallPart::tube) != entry.parts.end();
  };
  const bool uses_tube = std::ranges::any_of(study.experiments, [&](dem::Experiment one) {
    return one->needs_tube || (study.has_own_tube && is_in_tube(*one));
  });
  if (!uses_tube) {
    if (study.has_own_tube && plan.errors.empty()) {
      plan.errors.push_back(fmt::format(
          "--tube-mm {}: none of the experiments has a tube. Fix: leave it out, or add {} to "
          "--experiments.",
          arguments.tube_mm, dem::experiment_names({.is_meant = is_in_tube})));
    }
    return;
  }
  constexpr double kFewestAcross = 3;  // fewer jam
  const double longest_mm = *std::max_element(study.sizes_mm.begin(), study.sizes_mm.end());
  if (study.tube_diameter_mm < kFewestAcross * longest_mm) {
    plan.errors.push_back(fmt::format(
        "--tube-mm {:g}x{:g}: grains of {:g} mm jam in it. Rule: three grains across, or more. "
        "Fix: use a tube of {:g} mm, or more.",
        study.tube_diameter_mm, study.tube_height_mm, longest_mm, kFewestAcross * longest_mm));
  } else if (calibrate::grains_in_tube(study) > kMaxGrains) {
    plan.errors.push_back(fmt::format(
        "--tube-mm {:g}x{:g}: takes about {:.0f} grains. Rule: at most {:.0f}. Fix: use a smaller "
        "tube.",
        study.tube_diameter_mm, study.tube_height_mm, calibrate::grains_in_tube(study),
        kMaxGrains));
  }
}

/// The usual ones, or those typed.
void read_experiments(const NewArguments& arguments, NewPlan& plan) {
  std::vector<std::string> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    names.emplace_back(entry.name);
    if (arguments.experiments.empty() && entry.is_default) {
      plan.study.experiments.push_back(&entry);
    }
  }
  for (const std::size_t place :
       read_words({"--experiments", arguments.experiments, plan.errors}, names)) {
    plan.study.experiments.push_back(&dem::all_experiments()[place]);
  }
}

void read_file(const NewArguments& arguments, NewPlan& plan) {
  plan.file = arguments.study;
  if (plan.file.extension() != ".toml" || plan.file.stem().empty()) {
    plan.errors.push_back(
        fmt::format("{}: a study's name ends in .toml. Fix: repose new {}.toml.", arguments.study,
                    plan.file.stem().empty() ? "my_study" : plan.file.stem().string()));
    return;
  }
  const auto is_control = [](unsigned char letter) { return std::iscntrl(letter) != 0; };
  if (std::any_of(arguments.study.begin(), arguments.study.end(), is_control)) {
    plan.errors.push_back(
        fmt::format("{}: a study's name has no control characters. Fix: choose another name.",
                    base::printable(arguments.study)));
    return;
  }
  if (!base::is_utf8(arguments.study)) {
    plan.errors.push_back(fmt::format(
        "{}: is not UTF-8, as the study, which names the folder of its sheets, must be. Fix: "
        "choose another name, and do without other encodings in names of folders.",
        base::printable(arguments.study)));
    return;
  }
  try {
    calibrate::check_new_places(plan.file);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
  }
}

NewPlan plan_new(const NewArguments& arguments) {
  NewPlan plan;
  read_file(arguments, plan);
  read_kinds(arguments, plan);
  read_grain(arguments, plan);
  read_experiments(arguments, plan);
  read_parts(arguments, plan);
  read_tube(arguments, plan);
  return plan;
}

/// What is not measured yet, and stands in the study all the same.
std::string assumptions_of(const calibrate::NewStudy& study) {
  std::string text = "Assumed, to be replaced by your own:";
  if (!study.has_own_sizes) {
    text += fmt::format(" grains of {:g} mm (--grain-mm),", fmt::join(study.sizes_mm, " x "));
  }
  if (!study.has_own_density) {
    text += fmt::format(" {:g} kg/m³ (--density-kg-m3),", study.density_kg_m3);
  }
  if (!study.has_own_tube && needs_tube(study)) {
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
    table.add_row({(folder / sheet.name).string(), std::string(sheet.experiment->value_name),
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

/// With the usual ones, as they are typed.
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
                   .words = grain_names()},
                  {"--grain-mm", "L,W,T", "Length, width, thickness (typical)", &given->grain_mm},
                  {"--density-kg-m3", "D", "Density of a grain (typical)", &given->density_kg_m3},
                  {.name = "--plate",
                   .value_name = "KIND",
                   .help = "Material of the plate (steel)",
                   .target = &given->plate,
                   .words = plate_names()},
                  {.name = "--tube",
                   .value_name = "KIND",
                   .help = "Material of the tube (as the plate)",
                   .target = &given->tube,
                   .words = plate_names()},
                  {.name = "--incline",
                   .value_name = "KIND",
                   .help = "Material of the incline (as the plate)",
                   .target = &given->incline,
                   .words = plate_names()},
                  {.name = "--pane",
                   .value_name = "KIND",
                   .help = "Material of a box's walls (as the plate)",
                   .target = &given->pane,
                   .words = plate_names()},
                  {"--tube-mm", "DxH", "Inner diameter and height (from grain size)",
                   &given->tube_mm},
                  {"--experiments", "A,B,...", experiments_help(), &given->experiments}},
      .notes = kNewNotes,
      .missing = "no study file given. Fix: repose new my_study.toml.",
      .run = [given] { return run_new(*given); }};
}

}  // namespace repose::cli
