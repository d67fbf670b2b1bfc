#include "calibrate/start/new_request.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "base/units.h"
#include "calibrate/start/usual_experiment.h"
#include "dem/contact/adhesion.h"
#include "dem/shape/scan/calliper.h"

namespace repose::calibrate {
namespace {

constexpr double kMaxGrains = 100'000;  // in an experiment
constexpr double kFewestAcross = 3;     // fewer jam in a tube

template <typename Kinds>
std::vector<std::string> names_in(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto& kind : kinds) names.emplace_back(kind.name);
  return names;
}

/// Index of a word in a list; std::nullopt, with an error, if it is not there.
std::optional<std::size_t> place_of(const char* field, const std::string& word,
                                    const std::vector<std::string>& known, base::Faults& faults) {
  const auto found = std::ranges::find(known, word);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  const std::string guess = base::closest_word(word, known);
  faults.add({.subject = field,
              .value = fmt::format("is {}, which is unknown{}", word,
                                   guess.empty() ? "" : fmt::format(". Did you mean {}?", guess)),
              .fix = fmt::format("{}.", fmt::join(known, ", "))});
  return std::nullopt;
}

template <typename Kind>
const Kind& kind_named(const char* field, const std::string& said, std::string_view usual,
                       std::span<const Kind> kinds, base::Faults& faults) {
  const std::vector<std::string> names = names_in(kinds);
  const auto otherwise = std::ranges::find(names, usual) - names.begin();
  if (said.empty()) return kinds[static_cast<std::size_t>(otherwise)];
  const auto place = place_of(field, said, names, faults);
  return kinds[place.value_or(static_cast<std::size_t>(otherwise))];
}

void take_grain(const NewRequest& request, NewStudy& study, base::Faults& faults) {
  study.grain = kind_named("kind of grain", request.grains, kUsualGrain, grain_kinds(), faults);
  study.plate = kind_named("plate", request.plate, kUsualPlate, plate_kinds(), faults);
  study.has_own_sizes = request.grain_mm.has_value();
  study.sizes_mm = request.grain_mm.value_or(study.grain.sizes);
  const dem::CalliperSizes sizes{.length_m = study.sizes_mm[0] * kMPerMm,
                                 .width_m = study.sizes_mm[1] * kMPerMm,
                                 .thickness_m = study.sizes_mm[2] * kMPerMm};
  const std::vector<base::Fault> problems = sizes.problems();
  faults.add_all(problems);
  if (!problems.empty()) study.sizes_mm = study.grain.sizes;
  constexpr double kLightest = 10, kHeaviest = 25000;  // foam, osmium; g/cm3 lie below
  study.has_own_density = request.density_kg_m3.has_value();
  study.density_kg_m3 = request.density_kg_m3.value_or(study.grain.density_kg_m3);
  faults.require(study.density_kg_m3 >= kLightest && study.density_kg_m3 <= kHeaviest,
                 {.subject = "density",
                  .value = fmt::format("is {:g}", study.density_kg_m3),
                  .rule = fmt::format("a number of kg/m3 from {:g} to {:g}", kLightest, kHeaviest),
                  .fix = "water is 1000; multiply g/cm3 by 1000."});
}

/// The default ones, or those named, each once, in the order of the list.
void take_experiments(const NewRequest& request, NewStudy& study, base::Faults& faults) {
  const std::span<const dem::ExperimentEntry> all = dem::all_experiments();
  std::vector<bool> is_chosen(all.size(), false);
  for (const std::string& name : request.experiments) {
    if (const auto place = place_of("experiments", name, names_in(all), faults)) {
      is_chosen[*place] = true;
    }
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (request.experiments.empty() ? all[k].is_default : is_chosen[k]) {
      study.experiments.push_back(&all[k]);
    }
  }
}

bool has_part(const dem::ExperimentEntry& entry, dem::WallPart part) {
  return std::ranges::find(entry.parts, part) != entry.parts.end();
}

/// A material for a part that no experiment has would be useless.
void take_parts(const NewRequest& request, NewStudy& study, base::Faults& faults) {
  for (const auto& [part, said] : request.parts) {
    if (said.empty()) continue;
    const std::string field = name_of(part);
    const std::vector<std::string> names = names_in(plate_kinds());
    const auto kind = place_of(field.c_str(), said, names, faults);
    if (!kind) continue;
    std::vector<std::string_view> those_with;
    bool is_there = false;
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
      if (!has_part(entry, part)) continue;
      those_with.push_back(entry.name);
      is_there |= std::ranges::find(study.experiments, &entry) != study.experiments.end();
    }
    const PlateKind& plate = plate_kinds()[*kind];
    if (!is_there) {
      faults.add({.subject = field,
                  .value = fmt::format("of {}: none of the experiments has one", said),
                  .fix = fmt::format("leave it out, or add {} to the {}.",
                                     fmt::join(those_with, " or "), base::field("experiments"))});
    } else if (plate.name != study.plate.name) {
      study.parts.emplace(part, plate);
    }
  }
}

/// Checks a tube that an experiment needs.
void check_tube(const NewStudy& study, base::Faults& faults) {
  const double longest_mm = *std::ranges::max_element(study.sizes_mm);
  const std::string said =
      fmt::format("is {:g} x {:g} mm", study.tube_diameter_mm, study.tube_height_mm);
  if (study.tube_diameter_mm < kFewestAcross * longest_mm) {
    faults.add({.subject = "size of the tube",
                .value = fmt::format("{}: grains of {:g} mm jam in it", said, longest_mm),
                .rule = "three grains across, or more",
                .fix = fmt::format("use a tube of {:g} mm, or more.", kFewestAcross * longest_mm)});
  } else if (grains_in_tube(study) > kMaxGrains) {
    faults.add(
        {.subject = "size of the tube",
         .value = fmt::format("{}: it takes about {:.0f} grains", said, grains_in_tube(study)),
         .rule = fmt::format("at most {:.0f}", kMaxGrains),
         .fix = "use a smaller tube."});
  }
}

void take_tube(const NewRequest& request, NewStudy& study, base::Faults& faults) {
  study.tube_diameter_mm = usual_tube_diameter_mm(study.sizes_mm);
  study.tube_height_mm = 3 * study.tube_diameter_mm;
  if (request.tube_mm) {
    const auto [diameter_mm, height_mm] = *request.tube_mm;
    if (!(diameter_mm > 0 && height_mm > 0)) {
      faults.add({.subject = "size of the tube",
                  .value = fmt::format("is {:g} x {:g} mm", diameter_mm, height_mm),
                  .rule = "inner diameter and height, both above 0",
                  .fix = "50 x 150, say."});
      return;
    }
    study.tube_diameter_mm = diameter_mm;
    study.tube_height_mm = height_mm;
    study.has_own_tube = true;
  }
  const auto is_in_tube = [](const dem::ExperimentEntry& entry) {
    return has_part(entry, dem::WallPart::tube);
  };
  const bool uses_tube = std::ranges::any_of(study.experiments, [&](dem::Experiment one) {
    return one->needs_tube || (study.has_own_tube && is_in_tube(*one));
  });
  if (uses_tube) {
    check_tube(study, faults);
  } else if (study.has_own_tube && faults.empty()) {
    faults.add({.subject = "size of the tube",
                .value = "is given, and none of the experiments has a tube",
                .fix = fmt::format("leave it out, or add {} to the {}.",
                                   dem::experiment_names({.is_meant = is_in_tube}),
                                   base::field("experiments"))});
  }
}

/// Checks that a file of this name can be a study and can be created.
void check_name(const std::filesystem::path& file, base::Faults& faults) {
  const std::string name = file.string();
  if (file.extension() != ".toml" || file.stem().empty()) {
    faults.add({.where = base::printable(name),
                .value = "a study's name ends in .toml",
                .fix = fmt::format(
                    "repose new {}.toml.",
                    file.stem().empty() ? "my_study" : base::printable(file.stem().string()))});
    return;
  }
  const auto is_control = [](unsigned char letter) { return std::iscntrl(letter) != 0; };
  if (std::ranges::any_of(name, is_control)) {
    faults.add({.where = base::printable(name),
                .value = "a study's name has no control characters",
                .fix = "choose another name."});
    return;
  }
  if (!base::is_utf8(name)) {
    faults.add(
        {.where = base::printable(name),
         .value = "is not UTF-8, as the study, which names the folder of its sheets, must be",
         .fix = "choose another name, and do without other encodings in names of folders."});
    return;
  }
  try {
    check_new_places(file);
  } catch (const base::InputError& error) {
    faults.add_all(error.faults());
  }
}

}  // namespace

RequestedStudy requested_study(const NewRequest& request) {
  RequestedStudy made;
  base::Faults faults;
  check_name(request.study, faults);
  take_grain(request, made.study, faults);
  take_experiments(request, made.study, faults);
  take_parts(request, made.study, faults);
  take_tube(request, made.study, faults);
  made.faults = faults.all();
  return made;
}

std::vector<Assumption> assumptions_of(const NewStudy& study) {
  std::vector<Assumption> assumed;
  if (!study.has_own_sizes) {
    assumed.push_back({fmt::format("grains of {:g} mm", fmt::join(study.sizes_mm, " x ")), "size"});
  }
  if (!study.has_own_density) {
    assumed.push_back({fmt::format("{:g} kg/m³", study.density_kg_m3), "density"});
  }
  if (!study.has_own_tube && needs_tube(study)) {
    assumed.push_back(
        {fmt::format("a tube of {:g} x {:g} mm", study.tube_diameter_mm, study.tube_height_mm),
         "size of the tube"});
  }
  if (!study.parts.empty()) {
    std::vector<std::string> parts;
    for (const auto& [part, plate] : study.parts) parts.push_back(name_of(part));
    assumed.push_back({fmt::format("the coefficients of {}", fmt::join(parts, " and ")), ""});
  }
  assumed.push_back({"the stiffness of grains and plate", ""});
  return assumed;
}

std::optional<std::string> sticking_of(const NewStudy& study) {
  const auto& [length_mm, width_mm, thickness_mm] = study.sizes_mm;
  const double volume_m3 =
      std::numbers::pi / 6 * length_mm * width_mm * thickness_mm * std::pow(kMPerMm, 3);
  const auto sticky = dem::adhesion_warning(volume_m3, study.density_kg_m3);
  return sticky ? std::optional(*sticky + '.') : std::nullopt;
}

std::string new_command(const NewRequest& request) {
  std::string line = "repose new " + base::shell_word(request.study.string());
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {} {}", option, base::shell_word(value));
  };
  add("--grains", request.grains);
  if (request.grain_mm) add("--grain-mm", fmt::format("{:g}", fmt::join(*request.grain_mm, ",")));
  if (request.density_kg_m3) add("--density-kg-m3", fmt::format("{:g}", *request.density_kg_m3));
  add("--plate", request.plate);
  for (const auto& [part, said] : request.parts) add(("--" + name_of(part)).c_str(), said);
  if (request.tube_mm) add("--tube-mm", fmt::format("{:g}", fmt::join(*request.tube_mm, "x")));
  add("--experiments", fmt::format("{}", fmt::join(request.experiments, ",")));
  return line;
}

}  // namespace repose::calibrate
