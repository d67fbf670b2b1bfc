#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "calibrate/start/new_study.h"
#include "calibrate/statistics/bench/sheet.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kLine = 98;

/// Lines that begin with "# ".
std::string comment(const std::string& text) {
  std::string lines;
  for (const std::string& line : base::wrapped(text, kLine)) lines += "# " + line + '\n';
  return lines;
}

/// As people write it in TOML: 1e8, not 1e+08.
std::string number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  const std::size_t plus = text.find("e+");
  if (plus == std::string::npos) return text;
  return text.substr(0, plus) + 'e' + text.substr(text.find_first_not_of("+0", plus + 1));
}

/// Text as TOML has it.
std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

/// How many spheres follow the shape to a few percent of its volume.
int spheres_for(const std::array<double, 3>& sizes_mm) {
  constexpr double kRound = 1.02, kNearlyRound = 1.3;
  constexpr int kFew = 5, kUsual = 11;
  const auto [least, most] = std::minmax_element(sizes_mm.begin(), sizes_mm.end());
  if (*most <= kRound * *least) return 1;
  return *most <= kNearlyRound * *least ? kFew : kUsual;
}

/// To about 10 MPa: softer heaps move, stiffer ones take long.
double softening_for(double young_modulus_pa) {
  constexpr double kSoft_pa = 1.25e7;
  return std::min(1., std::pow(10, std::round(std::log10(kSoft_pa / young_modulus_pa))));
}

/// The protocol with what was said of the bench.
dem::Protocol protocol_of(const dem::ExperimentEntry& entry, const NewStudy& study) {
  dem::Protocol protocol = entry.usual;
  if (auto* heap = std::get_if<dem::HeapProtocol>(&protocol)) {
    constexpr double kMPerMm = 1e-3, kPlateWidths = 6;  // how far a low heap reaches, and more
    heap->tube_diameter_m = study.tube_diameter_mm * kMPerMm;
    heap->tube_height_m = study.tube_height_mm * kMPerMm;
    heap->plate_m = kPlateWidths * heap->tube_diameter_m;
  }
  return protocol;
}

std::string particle_section(const NewStudy& study) {
  const auto& [length, width, thickness] = study.sizes_mm;
  std::string text = "[particle]\n";
  text += fmt::format("name = \"{}\"\n", study.grain.name);
  text += comment(
      study.has_own_sizes
          ? "Length, width and thickness by calliper, ideally the means of at least 20 grains."
          : "Length, width and thickness: assumed; measure at least 20 grains with a calliper.");
  text += fmt::format("size_mm = [{}, {}, {}]\n", number(length), number(width), number(thickness));
  text += comment("Number of spheres per grain: more follow its shape better, but take longer.");
  text += fmt::format("spheres = {}\n", spheres_for(study.sizes_mm));
  text +=
      comment(study.has_own_density ? "Density of a grain, not of the bulk."
                                    : "Density of a grain, not of the bulk: assumed. repose "
                                      "bench density computes it from a mass and displaced water.");
  text += fmt::format("density_kg_m3 = {}\n", number(study.density_kg_m3));
  text += comment("Assumed. They hardly affect where grains come to rest.");
  text += fmt::format("young_modulus_pa = {}\n", number(study.grain.young_modulus_pa));
  text += fmt::format("poisson_ratio = {}\n", number(study.grain.poisson_ratio));
  const auto& [red, green, blue] = study.grain.colour;
  text += comment("Approximate colour, for pictures: red, green and blue from 0 to 255.");
  return text + fmt::format("colour = [{}, {}, {}]\n", red, green, blue);
}

std::string wall_section(const PlateKind& plate) {
  return "[wall]\n" + comment("Material of plate, incline and tube; textbook values.") +
         fmt::format("name = \"{}\"\nyoung_modulus_pa = {}\npoisson_ratio = {}\n", plate.name,
                     number(plate.young_modulus_pa), number(plate.poisson_ratio));
}

bool is_told(const NewStudy& study, const std::string& coefficient) {
  return std::any_of(study.experiments.begin(), study.experiments.end(), [&](dem::Experiment one) {
    return dem::depends_on(dem::entry_of(one), coefficient);
  });
}

/// Bounds, and between them a value for repose simulate.
std::string coefficient_line(const NewStudy& study, const std::string& pair,
                             const std::string& name, const CoefficientBounds& bounds) {
  const std::string middle = number(std::round(500 * (bounds.min + bounds.max)) / 1000);
  if (!is_told(study, fmt::format("contact.{}.{}", pair, name))) {
    return fmt::format("{} = {}  # no experiment of this study depends on it\n", name, middle);
  }
  return fmt::format("{} = {{ value = {}, min = {}, max = {} }}\n", name, middle,
                     number(bounds.min), number(bounds.max));
}

std::string contact_section(const NewStudy& study, const std::string& pair,
                            const ContactBounds& bounds) {
  return fmt::format("[contact.{}]\n", pair) +
         coefficient_line(study, pair, "restitution", bounds.restitution) +
         coefficient_line(study, pair, "sliding_friction", bounds.sliding_friction) +
         coefficient_line(study, pair, "rolling_friction", bounds.rolling_friction);
}

std::string contacts(const NewStudy& study) {
  std::string text = comment(
      "Coefficients to fit, each between bounds; the value is for repose simulate. For one that "
      "you "
      "know, or that no remaining experiment depends on, write a number: restitution = 0.31");
  text += comment(study.grain.source.empty()
                      ? std::string("Bounds: wide enough for any dry grain; narrow them if you "
                                    "know better.")
                      : fmt::format("Bounds: {}.", study.grain.source));
  text += "[contact]\nrolling_model = \"constant_torque\"  # EDEM's standard\n\n";
  text += contact_section(study, "particle_wall", study.grain.with_wall) + '\n';
  return text + contact_section(study, "particle_particle", study.grain.with_grain);
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
  return comment(text);
}

std::string experiment_section(const dem::ExperimentEntry& entry, const NewStudy& study,
                               const std::string& folder, const std::string& sheet) {
  const std::string place = folder + '/' + sheet;
  std::string text = comment(fmt::format("{} Result: {}, {}.", entry.description, entry.value_name,
                                         entry.unit == "deg" ? "degrees" : entry.unit));
  text += sheet_comment(entry, place);
  text += fmt::format("[experiment.{}]\n", entry.name);
  dem::Protocol protocol = protocol_of(entry, study);
  for (const dem::ProtocolKey& key : entry.keys(protocol)) {
    if (const auto value = value_of(key)) {
      text += fmt::format("{} = {}\n", key.name, number(*value));
    }
  }
  if (dem::has_grain_contacts(entry.experiment) && entry.softening_effect.empty()) {
    text += comment("Fraction of the real stiffness: softer grains are simulated faster.");
    text +=
        fmt::format("stiffness_factor = {}\n", number(softening_for(study.grain.young_modulus_pa)));
  }
  if (entry.is_pictured) {
    text += comment(fmt::format(
        "To use photographs instead of a sheet, put them into a folder and name it here:\n"
        "measured = {{ pictures = [{}] }}",
        toml_text(folder + "/photos")));
  }
  return text + fmt::format("measured = {{ readings = {} }}\n", toml_text(place));
}

}  // namespace

double usual_tube_diameter_mm(const std::array<double, 3>& sizes_mm) {
  constexpr double kGrainsAcross = 6, kStep_mm = 10;
  const double grain_mm = std::cbrt(sizes_mm[0] * sizes_mm[1] * sizes_mm[2]);
  return kStep_mm * std::ceil(kGrainsAcross * grain_mm / kStep_mm);
}

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
    const dem::ExperimentEntry& entry = dem::entry_of(experiment);
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

std::string study_text(const NewStudy& study, const std::string& folder) {
  std::string text = comment(fmt::format(
      "{}: a study to calibrate. Lines that begin with # are comments; units are part of the "
      "names: _mm, _deg, _pa. Fill in the sheets in {}/, replace assumed values by your own, and "
      "delete the experiments that you cannot do.",
      title_of(study), folder));
  text += fmt::format("\n[study]\ntitle = \"{}\"\n", title_of(study));
  text +=
      "# author = \"your name\"\n# date = \"when\"\n# note = \"variety, moisture, who poured the "
      "heaps\"\n\n";
  text += particle_section(study) + '\n' + wall_section(study.plate) + '\n' + contacts(study);
  for (const NewSheet& sheet : sheets_of(study)) {
    text += '\n' + experiment_section(dem::entry_of(sheet.experiment), study, folder, sheet.name);
  }
  return text;
}

}  // namespace repose::calibrate
