#include "dem/study/read_particle.h"

#include <algorithm>
#include <array>
#include <system_error>

#include <fmt/format.h>

#include "base/units.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualWallDensity_kg_m3 = 7850;  // steel; no effect, but must be a number

/// A unit in which a number may have been given by mistake.
struct Slip {
  const char* unit = "";
  double factor = 1;  ///< to the key's own unit
};

/// A material property: its range in real materials, and the range the program can compute with.
struct ParticleProperty {
  const char* key = "";
  Range possible;
  Range plausible;
  Range usual;  ///< in which a number converted from another unit must lie
  const char* examples = "";
  std::array<Slip, 3> slips = {};  ///< most likely first
};

constexpr ParticleProperty kYoung{
    .key = "young_modulus_pa",
    .possible = kPossibleYoung_pa,
    .plausible = from_to(1e6, 1.3e12),
    .usual = from_to(1e7, 5e11),
    .examples = "Pa: soaked seeds 1e7, nuts and plastics 1e9, glass 7e10, steel 2e11",
    .slips = {{{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}}};
constexpr ParticleProperty kDensity{
    .key = "density_kg_m3",
    .possible = kPossibleDensity_kg_m3,
    .plausible = from_to(10, 25'000),
    .usual = from_to(100, 25'000),
    .examples = "kg/m3: foam 20, wood and seeds 500 to 1300, steel 7850, tungsten 19300",
    .slips = {{{"g/cm3", 1e3}, {"t/m3", 1e3}, {"kg/mm3", 1e9}}}};

/// Checks the names of properties that may have any possible value.
void check_allowed(Section& section) {
  const char* example = "allow = [\"young_modulus_pa\"]";
  const auto allowed = section.texts("allow", example);
  if (!allowed) return;
  for (const std::string& name : *allowed) {
    if (name == kYoung.key || name == kDensity.key) continue;
    section.wrong(*section.value("allow"),
                  fmt::format("names of keys: \"{}\", \"{}\"", kYoung.key, kDensity.key),
                  fmt::format("for example {}", example));
  }
}

bool is_allowed(Section& section, const std::string& key) {
  const ConfigValue* allowed = section.value("allow");
  return allowed != nullptr &&
         std::any_of(allowed->items.begin(), allowed->items.end(),
                     [&](const ConfigValue& item) { return item.text == key; });
}

/// A number in a wrong unit may be possible but simulates something else, which nothing would
/// detect later.
void check_plausible(Section& section, const ParticleProperty& property) {
  const ConfigValue* value = section.value(property.key);
  if (value == nullptr || !property.possible.contains(value->number)) return;  // reported elsewhere
  if (property.plausible.contains(value->number) || is_allowed(section, property.key)) return;
  std::string fix;
  for (const auto& [unit, factor] : property.slips) {
    if (!property.usual.contains(value->number * factor)) continue;
    fix = fmt::format("{:g} if it was in {}; ", value->number * factor, unit);
    break;
  }
  section.wrong(*value,
                fmt::format("{:g} to {:g} {}", property.plausible.from, property.plausible.to,
                            property.examples),
                fmt::format("{}or, if it is meant, add allow = [\"{}\"] to [{}]", fix, property.key,
                            section.path()));
}

void read_material(Section& section, const std::string& otherwise, Material& material) {
  material.name = section.text("name", "name = \"hazelnut\"").value_or(otherwise);
  check_allowed(section);
  material.young_modulus_pa =
      section.needed_number("young_modulus_pa", kYoung.possible, "young_modulus_pa = 1.254e9");
  check_plausible(section, kYoung);
  check_plausible(section, kDensity);
  material.poisson_ratio =
      section.needed_number("poisson_ratio", kPossiblePoisson, "poisson_ratio = 0.38");
}

void read_wall_material(Section& wall, const std::string& otherwise, Material& material) {
  read_material(wall, otherwise, material);
  material.density_kg_m3 = wall.number("density_kg_m3", kDensity.possible, "density_kg_m3 = 7850")
                               .value_or(kUsualWallDensity_kg_m3);
}

void read_scan_source(Section& particle, const NamedFiles& files, GrainSource& grain) {
  const char* example = "scan = \"nut.stl\"";
  const auto scan = particle.text("scan", example);
  if (scan) grain.scan = file_named(particle, *particle.value("scan"), *scan, files);
  const ConfigValue* value = particle.value("unit");
  const std::string rule = "\"mm\" or \"m\": a scan does not say what its numbers count";
  if (value == nullptr) {
    if (scan) particle.missing("unit", rule, "unit = \"mm\"");
    return;
  }
  const auto unit = particle.text("unit", "unit = \"mm\"");
  if (!unit) return;
  if (*unit != "mm" && *unit != "m") {
    particle.wrong(*value, rule, "for example unit = \"mm\"");
  } else if (!particle.has("scan")) {
    particle.wrong(*value, "only a scan has a unit", "take this line out");
  }
  grain.scan_unit = *unit == "m" ? ScanUnit::metre : ScanUnit::millimetre;
}

void read_sizes(Section& particle, GrainSource& grain) {
  const char* example = "size_mm = [22.48, 18.23, 17.46]";
  const Range range = from_to(kSmallestGrain_m / kMPerMm, kLargestGrain_m / kMPerMm);
  const auto sizes = particle.numbers("size_mm", range, example);
  const auto tip = particle.number("tip", from_to(0, 1), "tip = 0.5");
  if (tip && !particle.has("size_mm")) {
    particle.wrong(*particle.value("tip"), "only calliper sizes have a tip", "take this line out");
  }
  if (!sizes) return;
  if (sizes->size() != 3) {
    particle.wrong(*particle.value("size_mm"), "length, width and thickness",
                   fmt::format("for example {}", example));
    return;
  }
  grain.sizes = CalliperSizes{.length_m = (*sizes)[0] * kMPerMm,
                              .width_m = (*sizes)[1] * kMPerMm,
                              .thickness_m = (*sizes)[2] * kMPerMm,
                              .tip_fraction = tip.value_or(0)};
}

double size_cv(Section& particle) {
  constexpr double kPercent = 100;
  return particle
             .number("size_sd_percent", from_to(0, kPercent * kMaxSizeSd), "size_sd_percent = 4.3")
             .value_or(0) /
         kPercent;
}

void read_filling(Section& particle, GrainSource& grain) {
  const auto spheres = particle.integer("spheres", 1, kMaxSpheres, "spheres = 11");
  const auto error = particle.number(
      "volume_error", {.from = 0, .to = 1, .excludes_from = true, .excludes_to = true},
      "volume_error = 0.05");
  if (spheres) grain.fill.spheres = static_cast<int>(*spheres);
  grain.fill.volume_error = error;
  if (particle.has("spheres") && particle.has("volume_error")) {
    particle.wrong(*particle.value("volume_error"), "spheres or volume_error, not both",
                   "take one of them out");
  }
  for (const char* key : {"spheres", "volume_error"}) {
    if (!particle.has("clump") || !particle.has(key)) continue;
    particle.wrong(*particle.value(key), "a clump file has its spheres", "take this line out");
  }
}

void read_colour(Section& particle, Study& study) {
  constexpr double kWhite = 255;
  const char* example = "colour = [217, 196, 143]";
  const auto colour = particle.numbers("colour", from_to(0, kWhite), example);
  if (!colour) return;
  if (colour->size() != 3) {
    particle.wrong(*particle.value("colour"), "red, green and blue",
                   fmt::format("for example {}", example));
    return;
  }
  study.grain_colour = {(*colour)[0] / kWhite, (*colour)[1] / kWhite, (*colour)[2] / kWhite};
}

/// Exactly one of the three must be given.
void check_one_shape(Section& particle) {
  const ConfigValue* first = nullptr;
  for (const char* key : {"scan", "size_mm", "clump"}) {
    if (!particle.has(key)) continue;
    const ConfigValue* value = particle.value(key);
    if (first != nullptr) {
      particle.wrong(*value, fmt::format("one shape only, and there is {} already", first->name),
                     "take one of them out");
    }
    first = value;
  }
  if (first == nullptr && particle.exists()) {
    particle.errors().add(particle.place(), "particle has no shape",
                          "one of scan, size_mm and clump",
                          "add scan = \"nut.stl\" with unit = \"mm\", size_mm = [22.5, 18.2, 17.5] "
                          "or clump = \"nut.json\" to [particle]");
  }
}

}  // namespace

fs::path file_named(const Section& section, const ConfigValue& value, const std::string& name,
                    const NamedFiles& files) {
  fs::path path = files.folder / name;
  std::error_code ignored;
  if (files.must_exist && !fs::exists(path, ignored)) {
    section.errors().add(value.place, fmt::format("{} = {}", section.full(value.name), value.shown),
                         fmt::format("a file that exists, and there is no {}", path.string()),
                         "correct the name; it is looked for beside the study file");
  }
  return path;
}

void read_particle(Section particle, const NamedFiles& files, Study& study) {
  read_scan_source(particle, files, study.grain);
  read_sizes(particle, study.grain);
  if (const auto clump = particle.text("clump", "clump = \"nut.json\"")) {
    study.grain.clump = file_named(particle, *particle.value("clump"), *clump, files);
  }
  check_one_shape(particle);
  study.model.size_cv = size_cv(particle);
  read_filling(particle, study.grain);
  read_colour(particle, study);
  read_material(particle, "particle", study.model.grain_material);
  study.model.grain_material.density_kg_m3 =
      particle.needed_number("density_kg_m3", kDensity.possible, "density_kg_m3 = 851");
  particle.reject_unknown_keys();
}

void read_wall(Section wall, Study& study) {
  read_wall_material(wall, "wall", study.model.wall_material);
  for (const auto& [part, part_name] : kWallParts) {
    const std::string key(part_name);
    Section own = wall.section(key);
    if (!wall.has(key)) continue;
    read_wall_material(own, key, study.model.parts[part].material);
    own.reject_unknown_keys();
  }
  wall.reject_unknown_keys();
}

}  // namespace repose::dem
