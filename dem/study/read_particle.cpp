#include "dem/study/read_particle.h"

#include <system_error>

#include <fmt/format.h>

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

constexpr double kMetres_mm = 1e-3;
constexpr double kUsualWallDensity_kg_m3 = 7850;  // steel; of no effect, but must be a number

void read_material(Section& section, const std::string& otherwise, Material& material) {
  material.name = section.text("name", "name = \"hazelnut\"").value_or(otherwise);
  material.young_modulus_pa =
      section.needed_number("young_modulus_pa", above(0), "young_modulus_pa = 1.254e9");
  material.poisson_ratio =
      section.needed_number("poisson_ratio", from_to_below(0, .5), "poisson_ratio = 0.38");
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
  const Range range = from_to(kSmallestGrain_m / kMetres_mm, kLargestGrain_m / kMetres_mm);
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
  grain.sizes = CalliperSizes{.length_m = (*sizes)[0] * kMetres_mm,
                              .width_m = (*sizes)[1] * kMetres_mm,
                              .thickness_m = (*sizes)[2] * kMetres_mm,
                              .tip_fraction = tip.value_or(0)};
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

/// Exactly one of three.
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
  read_filling(particle, study.grain);
  read_material(particle, "particle", study.model.grain_material);
  study.model.grain_material.density_kg_m3 =
      particle.needed_number("density_kg_m3", above(0), "density_kg_m3 = 851");
  particle.refuse_others();
}

void read_wall(Section wall, Study& study) {
  read_material(wall, "wall", study.model.wall_material);
  study.model.wall_material.density_kg_m3 =
      wall.number("density_kg_m3", above(0), "density_kg_m3 = 7850")
          .value_or(kUsualWallDensity_kg_m3);
  wall.refuse_others();
}

}  // namespace repose::dem
