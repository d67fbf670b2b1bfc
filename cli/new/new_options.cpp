#include "cli/new/new_options.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/units.h"
#include "calibrate/start/usual_experiment.h"
#include "cli/common/number.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "dem/shape/scan/calliper.h"
#include "dem/study/experiment_table.h"

namespace repose::cli {
namespace {

constexpr std::array kNewFields{base::FieldName{"size", "--grain-mm"}};
constexpr const char* kUsualPlate = "steel";
constexpr double kMostGrains = 100'000;  // of an experiment

template <typename Kind>
std::vector<std::string> names_of(std::span<const Kind> kinds) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

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
      if (std::ranges::find(chosen, entry.experiment) != chosen.end()) is_there = entry.name;
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
    const Typed typed{"--grain-mm", arguments.grain_mm, plan.errors};
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
    const auto diameter = number_in<double>(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos
                            ? std::nullopt
                            : number_in<double>(std::string_view(text).substr(cross + 1));
    if (!diameter || !height || *diameter <= 0 || *height <= 0) {
      const Typed typed{"--tube-mm", text, plan.errors};
      typed.refuse("inner diameter and height with an x between them, both more than 0",
                   "--tube-mm 50x150");
      return;
    }
    study.tube_diameter_mm = *diameter;
    study.tube_height_mm = *height;
    study.has_own_tube = true;
  }
  const auto is_done = [&](dem::Experiment one) {
    return std::ranges::find(study.experiments, one) != study.experiments.end();
  };
  if (!is_done(dem::Experiment::heap) && !(study.has_own_tube && is_done(dem::Experiment::fill))) {
    if (study.has_own_tube && plan.errors.empty()) {
      plan.errors.push_back(fmt::format(
          "--tube-mm {}: none of the experiments has a tube. Fix: leave it out, or add heap or "
          "fill to --experiments.",
          arguments.tube_mm));
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
  } else if (calibrate::grains_in_tube(study) > kMostGrains) {
    plan.errors.push_back(fmt::format(
        "--tube-mm {:g}x{:g}: takes about {:.0f} grains. Rule: at most {:.0f}. Fix: use a smaller "
        "tube.",
        study.tube_diameter_mm, study.tube_height_mm, calibrate::grains_in_tube(study),
        kMostGrains));
  }
}

/// The usual ones, or those typed.
void read_experiments(const NewArguments& arguments, NewPlan& plan) {
  std::vector<std::string> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    names.emplace_back(entry.name);
    if (arguments.experiments.empty() && entry.is_usual) {
      plan.study.experiments.push_back(entry.experiment);
    }
  }
  for (const std::size_t place :
       read_words({"--experiments", arguments.experiments, plan.errors}, names)) {
    plan.study.experiments.push_back(dem::all_experiments()[place].experiment);
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

}  // namespace

std::vector<std::string> grain_names() { return names_of(calibrate::grain_kinds()); }
std::vector<std::string> plate_names() { return names_of(calibrate::plate_kinds()); }

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

}  // namespace repose::cli
