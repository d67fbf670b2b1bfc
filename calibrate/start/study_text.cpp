#include "calibrate/start/study_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/angle_definition.h"
#include "base/text.h"
#include "calibrate/start/new_study.h"
#include "calibrate/start/usual_experiment.h"
#include "calibrate/statistics/bench/sheet.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

std::string toml_comment(const std::string& text) {
  constexpr std::size_t kLine = 98;
  std::string lines;
  for (const std::string& line : base::wrapped(text, kLine)) lines += "# " + line + '\n';
  return lines;
}

std::string toml_number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  const std::size_t plus = text.find("e+");
  if (plus == std::string::npos) return text;
  return text.substr(0, plus) + 'e' + text.substr(text.find_first_not_of("+0", plus + 1));
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

namespace {

/// Number of spheres that reproduce the shape to a few percent of its volume.
int spheres_for(const std::array<double, 3>& sizes_mm) {
  constexpr double kRound = 1.02, kNearlyRound = 1.3;
  constexpr int kFew = 5, kUsual = 11;
  const auto [least, most] = std::minmax_element(sizes_mm.begin(), sizes_mm.end());
  if (*most <= kRound * *least) return 1;
  return *most <= kNearlyRound * *least ? kFew : kUsual;
}

dem::UsualBench bench_of(const NewStudy& study) {
  return {.grain_mm = study.sizes_mm,
          .young_modulus_pa = study.grain.young_modulus_pa,
          .tube_diameter_mm = study.tube_diameter_mm,
          .tube_height_mm = study.tube_height_mm,
          .has_own_tube = study.has_own_tube};
}

std::string particle_section(const NewStudy& study) {
  const auto& [length, width, thickness] = study.sizes_mm;
  std::string text = "[particle]\n";
  text += fmt::format("name = \"{}\"\n", study.grain.name);
  text += toml_comment(
      study.has_own_sizes
          ? "Length, width and thickness by calliper, ideally the means of at least 20 grains."
          : "Length, width and thickness: assumed; measure at least 20 grains with a calliper.");
  text += fmt::format("size_mm = [{}, {}, {}]\n", toml_number(length), toml_number(width),
                      toml_number(thickness));
  text += "# size_sd_percent = 5  # standard deviation of the sizes, for heaps and other bulks\n";
  text +=
      toml_comment("Number of spheres per grain: more follow its shape better, but take longer.");
  text += fmt::format("spheres = {}\n", spheres_for(study.sizes_mm));
  text += toml_comment(study.has_own_density
                           ? "Density of a grain, not of the bulk."
                           : "Density of a grain, not of the bulk: assumed. repose "
                             "bench density computes it from a mass and displaced water.");
  text += fmt::format("density_kg_m3 = {}\n", toml_number(study.density_kg_m3));
  text += toml_comment("Assumed. They hardly affect where grains come to rest.");
  text += fmt::format("young_modulus_pa = {}\n", toml_number(study.grain.young_modulus_pa));
  text += fmt::format("poisson_ratio = {}\n", toml_number(study.grain.poisson_ratio));
  const auto& [red, green, blue] = study.grain.colour;
  text += toml_comment("Approximate colour, for pictures: red, green and blue from 0 to 255.");
  return text + fmt::format("colour = [{}, {}, {}]\n", red, green, blue);
}

std::string material_lines(const PlateKind& plate) {
  return fmt::format("name = \"{}\"\nyoung_modulus_pa = {}\npoisson_ratio = {}\n", plate.name,
                     toml_number(plate.young_modulus_pa), toml_number(plate.poisson_ratio));
}

std::string wall_sections(const NewStudy& study) {
  std::string text =
      "[wall]\n" +
      toml_comment(study.parts.empty()
                       ? "Material of plate, incline and tube; textbook values."
                       : "Material of the plate, and of what has no section of its own; textbook "
                         "values.") +
      material_lines(study.plate);
  for (const auto& [part, plate] : study.parts) {
    text += fmt::format("\n[wall.{}]\n", name_of(part)) + material_lines(plate);
  }
  return text;
}

bool is_told(const NewStudy& study, const std::string& coefficient) {
  return std::any_of(study.experiments.begin(), study.experiments.end(),
                     [&](dem::Experiment one) { return dem::depends_on(*one, coefficient); });
}

/// Bounds, and a value between them for `repose simulate`.
std::string coefficient_line(const NewStudy& study, const std::string& pair,
                             const std::string& name, const CoefficientBounds& bounds) {
  const std::string middle = toml_number(std::round(500 * (bounds.min + bounds.max)) / 1000);
  if (!is_told(study, fmt::format("contact.{}.{}", pair, name))) {
    return fmt::format("{} = {}  # no experiment of this study depends on it\n", name, middle);
  }
  return fmt::format("{} = {{ value = {}, min = {}, max = {} }}\n", name, middle,
                     toml_number(bounds.min), toml_number(bounds.max));
}

std::string contact_section(const NewStudy& study, const std::string& pair,
                            const ContactBounds& bounds) {
  return fmt::format("[contact.{}]\n", pair) +
         coefficient_line(study, pair, "restitution", bounds.restitution) +
         coefficient_line(study, pair, "sliding_friction", bounds.sliding_friction) +
         coefficient_line(study, pair, "rolling_friction", bounds.rolling_friction);
}

/// Contact of grains with a part of another material: no experiment identifies it well, so it is
/// assumed.
std::string part_section(const NewStudy& study, dem::WallPart part) {
  const auto line = [](const char* name, const CoefficientBounds& bounds) {
    return fmt::format("{} = {}\n", name,
                       toml_number(std::round(500 * (bounds.min + bounds.max)) / 1000));
  };
  const ContactBounds& bounds = study.grain.with_wall;
  return fmt::format("\n[contact.particle_{}]\n", name_of(part)) +
         toml_comment(fmt::format(
             "Assumed. Drop, tilt and roll the grains on a plate of {} to measure them: repose "
             "bench restitution, sliding and rolling.",
             study.parts.at(part).name)) +
         line("restitution", bounds.restitution) +
         line("sliding_friction", bounds.sliding_friction) +
         line("rolling_friction", bounds.rolling_friction);
}

std::string contacts(const NewStudy& study) {
  std::string text = toml_comment(
      "Coefficients to fit, each between bounds; the value is for repose simulate. For one that "
      "you "
      "know, or that no remaining experiment depends on, write a number: restitution = 0.31");
  text +=
      toml_comment(study.grain.source.empty()
                       ? std::string("Bounds: wide enough for any dry grain; narrow them if you "
                                     "know better.")
                       : fmt::format("Bounds: {}.", study.grain.source));
  text += toml_comment(
      "Say in the braces what the bounds are: bounds = \"known\", where no such material lies "
      "outside, or \"convenience\"; and with useful_half_width how narrow an interval you need.");
  text +=
      "[contact]\nrolling_model = \"constant_torque\"  # EDEM's standard\n"
      "damping = \"per_contact\"  # as in other programs; \"shared\": as if each pair touched "
      "once\n\n";
  text += contact_section(study, "particle_wall", study.grain.with_wall) + '\n';
  text += contact_section(study, "particle_particle", study.grain.with_grain);
  for (const auto& [part, plate] : study.parts) text += part_section(study, part);
  return text;
}

/// "drop_mm (height of fall H), rebound_mm (height of rebound h)".
std::string columns_text(const dem::ExperimentEntry& entry) {
  std::vector<std::string> columns;
  for (const ReadingColumn& column : columns_of(bench_test_named(entry.sheet.test))) {
    columns.push_back(fmt::format("{} ({})", column.name, column.what));
  }
  return fmt::format("{}", fmt::join(columns, ", "));
}

std::string sheet_comment(const dem::ExperimentEntry& entry, const std::string& sheet) {
  std::string text = fmt::format("{} has one row per reading: {}.", sheet, columns_text(entry));
  for (const auto& [column, key] : entry.sheet.protocol) {
    text += column == key ? fmt::format(" {} must be as below.", column)
                          : fmt::format(" {} must equal {} below.", column, key);
  }
  return toml_comment(text);
}

std::string experiment_section(const dem::ExperimentEntry& entry, const NewStudy& study,
                               const std::string& folder, const std::string& sheet) {
  const std::string place = folder + '/' + sheet;
  std::string text =
      toml_comment(fmt::format("{} Result: {}, {}.", entry.description, entry.value_name,
                               entry.unit == "deg" ? "degrees" : entry.unit));
  text += sheet_comment(entry, place);
  const dem::StudyExperiment usual = usual_experiment(entry, bench_of(study));
  if (entry.systematic != nullptr && entry.systematic(usual.protocol).sd > 0) {
    text += toml_comment(
        fmt::format("Until it is added below: {}.", entry.systematic(usual.protocol).note));
  }
  text += protocol_lines(entry, usual.protocol);
  if (dem::has_grain_contacts(&entry) && entry.softening_effect.empty()) {
    text += toml_comment("Fraction of the real stiffness: softer grains are simulated faster.");
    text += fmt::format("stiffness_factor = {}\n", toml_number(usual.stiffness_factor));
  }
  if (entry.is_pictured) {
    text += toml_comment(
        "By what the bench measured the angle: flank_20_80, the straight flank "
        "between 20 and 80 % of the height; or the name of another definition.");
    text += fmt::format("definition = \"{}\"\n", base::kUsualDefinition.name);
    text += toml_comment(fmt::format(
        "To use photographs or films instead of a sheet, put them into a folder and name it "
        "here; and say where the lens is, from the heap's middle and above the plate:\n"
        "measured = {{ pictures = [{}] }}\n"
        "camera_distance_mm = 1500\n"
        "camera_height_mm = 40",
        toml_text(folder + "/photos")));
  }
  return text + fmt::format("measured = {{ readings = {} }}\n", toml_text(place));
}

}  // namespace

double grains_in_tube(const NewStudy& study) {
  constexpr double kPacked = .6;
  const auto& [length, width, thickness] = study.sizes_mm;
  const double tube_mm3 =
      std::numbers::pi / 4 * study.tube_diameter_mm * study.tube_diameter_mm * study.tube_height_mm;
  return kPacked * tube_mm3 / (std::numbers::pi / 6 * length * width * thickness);
}

std::vector<NewSheet> sheets_of(const NewStudy& study) {
  std::vector<NewSheet> sheets;
  for (const dem::Experiment experiment : study.experiments) {
    const dem::ExperimentEntry& entry = *experiment;
    sheets.push_back(
        {.experiment = experiment,
         .name = fmt::format("{}{}.csv", entry.name, entry.name.ends_with('s') ? "" : "s"),
         .columns = column_names(bench_test_named(entry.sheet.test))});
  }
  return sheets;
}

std::string title_of(const NewStudy& study) {
  std::string title = fmt::format("{} on {}", study.grain.plural, study.plate.name);
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  return title;
}

bool needs_tube(const NewStudy& study) {
  return std::ranges::any_of(study.experiments, &dem::ExperimentEntry::needs_tube);
}

std::vector<std::string> assumed_names(const NewStudy& study) {
  std::vector<std::string> names;
  if (!study.has_own_sizes) names.emplace_back("particle.size_mm");
  if (!study.has_own_density) names.emplace_back("particle.density_kg_m3");
  const auto add_material = [&names](const std::string& section) {
    for (const char* key : {"young_modulus_pa", "poisson_ratio"}) {
      names.push_back(fmt::format("{}.{}", section, key));
    }
  };
  add_material("particle");
  add_material("wall");
  for (const auto& [part, plate] : study.parts) {
    add_material("wall." + name_of(part));
    for (const char* key : {"restitution", "sliding_friction", "rolling_friction"}) {
      names.push_back(fmt::format("contact.particle_{}.{}", name_of(part), key));
    }
  }
  for (const dem::Experiment experiment : study.experiments) {
    if (study.has_own_tube || !experiment->needs_tube) continue;
    for (const char* key : {"tube_diameter_mm", "tube_height_mm"}) {
      names.push_back(fmt::format("experiment.{}.{}", experiment->name, key));
    }
  }
  return names;
}

std::string study_text(const NewStudy& study, const std::string& folder) {
  std::string text = toml_comment(fmt::format(
      "{}: a study to calibrate. Lines that begin with # are comments; units are part of the "
      "names: _mm, _deg, _pa. Fill in the sheets in {}/, replace assumed values by your own, and "
      "delete the experiments that you cannot do.",
      title_of(study), folder));
  text += fmt::format("\n[study]\ntitle = \"{}\"\n", title_of(study));
  text +=
      "# author = \"your name\"\n# date = \"when\"\n# note = \"variety, moisture, who poured the "
      "heaps\"\n";
  text += toml_comment(
      "Values below that nobody has measured yet; results say so. Take a name out of this list "
      "when "
      "its value is your own.");
  text +=
      fmt::format("assumed = [\n  \"{}\",\n]\n\n", fmt::join(assumed_names(study), "\",\n  \""));
  text += particle_section(study) + '\n' + wall_sections(study) + '\n' + contacts(study);
  for (const NewSheet& sheet : sheets_of(study)) {
    text += '\n' + experiment_section(*sheet.experiment, study, folder, sheet.name);
  }
  return text;
}

}  // namespace repose::calibrate
