#include "dem/study/held_inputs.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/study/read_particle.h"

namespace repose::dem {
namespace {

constexpr double kPerPercent = .01;
constexpr const char* kSizePercent = "size_percent";
constexpr std::array<const char*, 3> kAxes = {"size_mm.length", "size_mm.width",
                                              "size_mm.thickness"};

/// Numbers of one section of a study.
struct Numbers {
  std::string section;  ///< "experiment.roll"
  std::vector<ProtocolKey> keys;
};

ProtocolKey percent_key(std::string name, std::string example, const Range& range, double& value) {
  ProtocolKey key = number_key(std::move(name), std::move(example), range, value);
  key.unit = kPerPercent;
  return key;
}

void add_material(Numbers& numbers, Material& material) {
  numbers.keys.push_back(
      number_key("young_modulus_pa", "1e9", kPossibleYoung_pa, material.young_modulus_pa));
  numbers.keys.push_back(
      number_key("poisson_ratio", "0.02", kPossiblePoisson, material.poisson_ratio));
}

Numbers numbers_of_particle(Study& study) {
  Numbers numbers{.section = "particle", .keys = {}};
  GrainSource& grain = study.grain;
  numbers.keys.push_back(percent_key(kSizePercent, "2", above(0, 1e3), grain.size_factor));
  if (grain.sizes) {
    CalliperSizes& sizes = *grain.sizes;
    for (const auto& [axis, size_m] : {std::pair(kAxes[0], &sizes.length_m),
                                       {kAxes[1], &sizes.width_m},
                                       {kAxes[2], &sizes.thickness_m}}) {
      numbers.keys.push_back(length_key(axis, "0.2", *size_m));
    }
    numbers.keys.push_back(number_key("tip", "0.1", from_to(0, 1), sizes.tip_fraction));
  }
  Model& model = study.model;
  if (model.size_cv > 0) {
    constexpr double kMax = kMaxSizeSd / kPerPercent;
    numbers.keys.push_back(percent_key("size_sd_percent", "0.5", above(0, kMax), model.size_cv));
  }
  numbers.keys.push_back(number_key("density_kg_m3", "20", kPossibleDensity_kg_m3,
                                    model.grain_material.density_kg_m3));
  add_material(numbers, model.grain_material);
  return numbers;
}

/// All numbers of a study, in the order of its sections.
std::vector<Numbers> numbers_of(Study& study) {
  std::vector<Numbers> all = {numbers_of_particle(study)};
  all.push_back({.section = "wall", .keys = {}});
  add_material(all.back(), study.model.wall_material);
  for (auto& [part, surface] : study.model.parts) {
    all.push_back({.section = "wall." + name_of(part), .keys = {}});
    add_material(all.back(), surface.material);
  }
  for (auto& [experiment, described] : study.experiments) {
    all.push_back({.section = "experiment." + name_of(experiment),
                   .keys = experiment->keys(described.protocol)});
  }
  return all;
}

/// Why a key cannot have an uncertainty; empty if it can.
std::string why_exact(const ProtocolKey& key) {
  if (std::holds_alternative<int*>(key.value) ||
      std::holds_alternative<std::optional<int>*>(key.value)) {
    return "a count is exact";
  }
  if (!value_of(key)) return "the study leaves this number out";
  if (key.is_of_pictures) return "it says how pictures are taken, and changes nothing simulated";
  return {};
}

void set(const ProtocolKey& key, double value) {
  if (double* const* number = std::get_if<double*>(&key.value)) **number = value * key.unit;
  if (std::optional<double>* const* number = std::get_if<std::optional<double>*>(&key.value)) {
    **number = value * key.unit;
  }
}

/// Change of the value: sd, -sd, or 0 if neither is allowed.
double step_of(const ProtocolKey& key, double sd) {
  const double value = value_of(key).value_or(0);
  if (key.range.contains(value + sd)) return sd;
  return key.range.contains(value - sd) ? -sd : 0;
}

void take(Section& section, const ConfigValue& stated, const std::string& name,
          const ProtocolKey& key, double sd, Study& study) {
  if (sd > 0 && step_of(key, sd) == 0) {
    section.wrong(
        stated,
        fmt::format("{:g} and its uncertainty: {}", value_of(key).value_or(0), key.range.rule()),
        "a smaller one, in the unit of the number itself");
    return;
  }
  study.stated_sd[name] = sd;
}

/// One number per axis, or one for all three.
void read_axes(Section& particle, const Numbers& numbers, Study& study) {
  const std::string example = "size_mm = [0.2, 0.15, 0.15]";
  const ConfigValue* stated = particle.value("size_mm");
  if (stated == nullptr) return;
  if (!study.grain.sizes) {
    particle.wrong(*stated, "only calliper sizes are known one by one",
                   fmt::format("{} = 2, of all lengths", kSizePercent));
    return;
  }
  if (particle.has(kSizePercent)) {
    particle.wrong(*stated, fmt::format("size_mm or {}, not both", kSizePercent),
                   "take one of them out");
    return;
  }
  const CalliperSizes& sizes = *study.grain.sizes;
  if (sizes.length_m == sizes.width_m && sizes.width_m == sizes.thickness_m) {
    particle.wrong(*stated, "a ball has one size",
                   fmt::format("{} = 2, of its diameter", kSizePercent));
    return;
  }
  std::vector<double> sd;
  if (stated->kind == ConfigValue::Kind::array) {
    sd = particle.numbers("size_mm", {.from = 0}, example).value_or(sd);
    if (!sd.empty() && sd.size() != kAxes.size()) {
      particle.wrong(*stated, "one number, or length, width and thickness",
                     fmt::format("for example {}", example));
      return;
    }
  } else if (const auto each = particle.number("size_mm", {.from = 0}, "size_mm = 0.2")) {
    sd.assign(kAxes.size(), *each);
  }
  for (std::size_t k = 0; k < sd.size(); ++k) {
    const auto key = std::ranges::find(numbers.keys, kAxes[k], &ProtocolKey::name);
    take(particle, *stated, "particle." + key->name, *key, sd[k], study);
  }
}

void read_numbers(Section section, const Numbers& numbers, Study& study) {
  if (!section.exists()) return;
  if (numbers.section == "particle") read_axes(section, numbers, study);
  for (const ProtocolKey& key : numbers.keys) {
    if (std::ranges::find(kAxes, key.name) != kAxes.end()) continue;
    const ConfigValue* stated = section.value(key.name);
    if (stated == nullptr) continue;
    if (const std::string why = why_exact(key); !why.empty()) {
      section.wrong(*stated, why, "take this line out");
      continue;
    }
    const auto sd =
        section.number(key.name, {.from = 0}, fmt::format("{} = {}", key.name, key.example));
    if (sd) take(section, *stated, numbers.section + '.' + key.name, key, *sd, study);
  }
  section.reject_unknown_keys();
}

/// Unit of a key, from its name: "lift_speed_mm_s" is in mm/s.
std::string unit_of(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kUnits = {
      {{"_kg_m3", "kg/m3"},
       {"_mm_s", "mm/s"},
       {"_deg_s", "deg/s"},
       {"_percent", "%"},
       {"_pa", "Pa"},
       {"_mm", "mm"},
       {"_deg", "deg"},
       {"_hz", "Hz"},
       {"_s", "s"}}};
  if (name.starts_with("size_mm.")) return "mm";
  for (const auto& [ending, unit] : kUnits) {
    if (name.ends_with(ending)) return std::string(unit);
  }
  return {};
}

/// Assumed uncertainty of a number without a stated one; 0: none.
double assumed_sd(const Study& study, const std::string& name, double value) {
  if (name == "wall.young_modulus_pa" || name == "particle.young_modulus_pa") {
    return kAssumedModulusFraction * value;
  }
  if (name == "particle.density_kg_m3") return kAssumedDensityFraction * value;
  const bool are_axes_stated = study.stated_sd.contains(std::string("particle.") + kAxes[0]);
  if (name == std::string("particle.") + kSizePercent && !are_axes_stated) {
    return kAssumedSizeFraction * value;
  }
  return 0;
}

}  // namespace

void read_uncertainty(Section uncertainty, Study& study) {
  if (!uncertainty.exists()) return;
  study.varies_inputs = uncertainty.truth("vary", "vary = false").value_or(true);
  const std::vector<Numbers> all = numbers_of(study);
  Section wall = uncertainty.section("wall");
  Section experiments = uncertainty.section("experiment");
  for (const Numbers& numbers : all) {
    const std::size_t dot = numbers.section.find('.');
    const std::string name = numbers.section.substr(dot + 1);
    if (numbers.section == "wall") {
      continue;  // below, after its parts, which are keys of it
    }
    if (dot == std::string::npos) {
      read_numbers(uncertainty.section(name), numbers, study);
    } else {
      read_numbers((numbers.section.starts_with("wall") ? wall : experiments).section(name),
                   numbers, study);
    }
  }
  read_numbers(wall, *std::ranges::find(all, "wall", &Numbers::section), study);
  experiments.reject_unknown_keys();
  uncertainty.reject_unknown_keys();
}

std::vector<HeldInput> held_inputs(const Study& study) {
  std::vector<HeldInput> inputs;
  if (!study.varies_inputs) return inputs;
  Study own = study;  // the keys hold pointers for writing
  for (const Numbers& numbers : numbers_of(own)) {
    for (const ProtocolKey& key : numbers.keys) {
      if (!why_exact(key).empty()) continue;
      HeldInput input{.name = numbers.section + '.' + key.name,
                      .unit = unit_of(key.name),
                      .value = *value_of(key)};
      const auto stated = study.stated_sd.find(input.name);
      input.is_assumed = stated == study.stated_sd.end();
      input.sd = input.is_assumed ? assumed_sd(study, input.name, input.value) : stated->second;
      input.step = step_of(key, input.sd);
      if (input.sd > 0 && input.step != 0) inputs.push_back(std::move(input));
    }
  }
  return inputs;
}

std::vector<std::string> inputs_taken_as_exact(const Study& study) {
  std::vector<std::string> names;
  Study own = study;
  for (const Numbers& numbers : numbers_of(own)) {
    if (!numbers.section.starts_with("experiment.")) continue;
    for (const ProtocolKey& key : with_effect(numbers.keys)) {
      const std::string name = numbers.section + '.' + key.name;
      if (why_exact(key).empty() && !study.stated_sd.contains(name)) names.push_back(name);
    }
  }
  return names;
}

void change_input(Study& study, const std::string& name, double change) {
  for (const Numbers& numbers : numbers_of(study)) {
    for (const ProtocolKey& key : numbers.keys) {
      if (numbers.section + '.' + key.name != name) continue;
      set(key, value_of(key).value_or(0) + change);
      return;
    }
  }
  throw base::InputError({.value = fmt::format("the study has no number {}", name)});
}

bool has_effect(std::string_view input, Experiment experiment) {
  const ExperimentEntry& entry = *experiment;
  if (input == "particle.size_sd_percent") return entry.is_bulk;
  constexpr std::string_view kExperiment = "experiment.", kWall = "wall.";
  const std::string_view section = input.substr(0, input.rfind('.'));
  if (section.starts_with(kExperiment)) return section.substr(kExperiment.size()) == entry.name;
  if (!section.starts_with(kWall)) return true;
  return std::ranges::any_of(
      entry.parts, [&](WallPart part) { return name_of(part) == section.substr(kWall.size()); });
}

}  // namespace repose::dem
