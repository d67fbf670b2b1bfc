// What was done on the bench and in simulations: grain, wall, each experiment's settings,
// measurements, and which of these the study does not state.
#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/angle_definition.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/study/study_record.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/config.h"

namespace repose::calibrate::report {
namespace {

constexpr double kMm = 1e3;

/// The study's text in the folder, to find out what it states; an empty table if it cannot be read.
dem::ConfigValue stated_in(const ReportedStudy& study) {
  try {
    const std::string file = (study.folder / kStudyCopy).string();
    dem::StudyErrors ignored;
    return dem::parse_config(file, base::read_whole_file(file), study.record->settings, ignored);
  } catch (const base::InputError&) {
    return {};
  }
}

const dem::ConfigValue* within(const dem::ConfigValue* table, const std::string& key) {
  return table == nullptr ? nullptr : table->find(key);
}

/// Whether a study states a value, and not merely as an assumption.
class Stated {
 public:
  Stated(const dem::ConfigValue* root, const std::vector<std::string>& assumed)
      : table_(root), assumed_(&assumed) {}

  Stated section(const std::string& key) const {
    Stated inner(within(table_, key), *assumed_);
    inner.path_ = path_ + key + '.';
    return inner;
  }
  bool is_marked(const std::string& key) const {
    return std::ranges::find(*assumed_, path_ + key) != assumed_->end();
  }
  bool operator()(const std::string& key) const {
    return within(table_, key) != nullptr && !is_marked(key);
  }

 private:
  const dem::ConfigValue* table_;
  const std::vector<std::string>* assumed_;
  std::string path_;
};

/// "tube_diameter_mm": "tube diameter", "mm".
std::pair<std::string, std::string> name_and_unit(const std::string& key) {
  for (const auto& [ending, unit] :
       {std::pair("_mm_s", "mm/s"), {"_deg_s", "°/s"}, {"_mm", "mm"}, {"_deg", "°"}}) {
    const std::string_view end = ending;
    if (key.ends_with(end)) return {spaced(key.substr(0, key.size() - end.size())), unit};
  }
  return {spaced(key), ""};
}

/// Settings of a grain, a wall or an experiment, stated in the study or assumed.
class Settings {
 public:
  void add(const std::string& what, const std::string& value, bool is_stated) {
    std::string& text = is_stated ? stated_ : assumed_;
    if (!text.empty()) text += ", ";
    text += what + ' ' + shortened(value, 200);
  }

  void add_to(Table& table, const std::string& of, const std::string& measured) const {
    table.data.add({of, stated_, assumed_.empty() ? "–" : assumed_, measured});
  }

 private:
  std::string stated_;
  std::string assumed_;
};

std::string shape_text(const dem::GrainSource& grain) {
  if (grain.scan) return "scan " + grain.scan->filename().string();
  if (grain.clump) return "clump " + grain.clump->filename().string();
  const dem::CalliperSizes& sizes = *grain.sizes;
  return fmt::format("{} × {} × {} mm by calliper", shown(kMm * sizes.length_m),
                     shown(kMm * sizes.width_m), shown(kMm * sizes.thickness_m));
}

void add_material(const dem::Material& material, const Stated& stated, Settings& settings) {
  settings.add("Young's modulus", shown(material.young_modulus_pa) + " Pa",
               !stated.is_marked("young_modulus_pa"));
  settings.add("Poisson's ratio", shown(material.poisson_ratio),
               !stated.is_marked("poisson_ratio"));
}

void add_materials(const StudyRecord& record, const Stated& stated, Table& table) {
  const dem::Study& study = record.study;
  const Stated particle = stated.section("particle");
  Settings grain;
  grain.add("shape:", shape_text(study.grain),
            !(particle.is_marked("size_mm") || particle.is_marked("scan") ||
              particle.is_marked("clump")));
  grain.add("spheres", fmt::format("{}", record.grain.shape.spheres.size()),
            study.grain.clump || particle("spheres") || particle("volume_error"));
  grain.add("density", shown(study.model.grain_material.density_kg_m3) + " kg/m³",
            !particle.is_marked("density_kg_m3"));
  add_material(study.model.grain_material, particle, grain);
  grain.add_to(table, "grain: " + shortened(study.model.grain_material.name), "–");
  const auto add_wall = [&table](const std::string& what, const dem::Material& material,
                                 const Stated& section) {
    Settings wall;
    add_material(material, section, wall);
    wall.add_to(table, what + ": " + shortened(material.name), "–");
  };
  const Stated wall = stated.section("wall");
  add_wall("wall", study.model.wall_material, wall);
  for (const auto& [part, surface] : study.model.parts) {
    add_wall(name_of(part), surface.material, wall.section(name_of(part)));
  }
}

std::string films_text(const StudyRecord& record, std::string_view experiment) {
  int films = 0, counted = 0;
  for (const FilmReading& film : record.measurement.films) {
    if (film.experiment != experiment) continue;
    ++films;
    counted += film.value ? 1 : 0;
  }
  return films == 0
             ? ""
             : fmt::format("{} film{}, {} of which could be read", films, films == 1 ? "" : "s",
                           counted == films ? "all" : fmt::format("{}", counted));
}

/// "10 readings", "mean of 10, scatter assumed".
std::string measured_text(const StudyRecord& record, const dem::ExperimentEntry& entry,
                          const dem::Measured& measured) {
  const std::size_t pictures = entry.is_pictured ? record.measurement.pictures.size() : 0;
  if (pictures > 0) {
    const char* kind = !measured.scans.empty()    ? "scan"
                       : !measured.videos.empty() ? "film"
                                                  : "photograph";
    const std::string heaps =
        measured.within_heaps ? fmt::format("{} heaps", measured.values.size()) : "heaps";
    return fmt::format("{} {}{} of {}", pictures, kind, pictures == 1 ? "" : "s", heaps);
  }
  if (!measured.videos.empty()) return films_text(record, entry.name);
  if (!measured.values.empty()) {
    return fmt::format("{} reading{}{}", measured.values.size(),
                       measured.values.size() == 1 ? ", scatter assumed" : "s",
                       measured.sheet ? " in " + measured.sheet->filename().string() : "");
  }
  if (!measured.mean) return "nothing";
  return fmt::format("mean of {}{}", measured.count.value_or(1),
                     measured.sd ? ", sd " + shown(measured.sd) : ", scatter assumed");
}

void add_experiment(const StudyRecord& record, const dem::ExperimentEntry& entry,
                    const Stated& stated, Table& table) {
  const auto described = record.study.experiments.find(&entry);
  if (described == record.study.experiments.end()) return;
  Settings settings;
  dem::Protocol protocol = described->second.protocol;
  for (const dem::ProtocolKey& key : with_effect(entry.keys(protocol))) {
    const auto value = dem::value_of(key);
    const auto [what, unit] = name_and_unit(key.name);
    settings.add(what,
                 value ? shown(value) + (unit.empty() ? "" : ' ' + unit) : std::string(key.absence),
                 stated(key.name));
  }
  settings.add("fraction of the real stiffness", shown(described->second.stiffness_factor),
               stated("stiffness_factor"));
  if (entry.is_pictured) {
    const std::string& definition = described->second.definition;
    settings.add("definition of the angle:", std::string(base::definition_meant(definition)),
                 !definition.empty() && !stated.is_marked("definition"));
  }
  settings.add_to(table, std::string(entry.name),
                  measured_text(record, entry, described->second.measured));
}

/// Each film's reading, or why there is none.
void add_films(const StudyRecord& record, Chapter& chapter) {
  if (record.measurement.films.empty()) return;
  Table table{.name = "films",
              .title =
                  "Films and the readings taken from them; ± is the half-width of the 95 % "
                  "interval",
              .data = {.columns = {{.name = "film", .unit = {}},
                                   {.name = "experiment", .unit = {}},
                                   {.name = "reading", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "unit", .unit = {}},
                                   {.name = "status", .unit = {}},
                                   {.name = "remark", .unit = {}}},
                       .rows = {}}};
  for (const FilmReading& film : record.measurement.films) {
    const auto if_read = [&](double value) {
      return cell(film.value ? std::optional(value) : std::nullopt);
    };
    table.data.add({shortened(film.file.filename().string()), film.experiment,
                    if_read(film.value.value_or(0)), if_read(film.uncertainty),
                    std::string(dem::experiment_named(film.experiment).unit), film.status,
                    film.reason.empty() ? "–" : shortened(film.reason, 400)});
  }
  chapter.blocks.push_back(std::move(table));
}

}  // namespace

Chapter protocol_chapter(const ReportedStudy& study) {
  Chapter chapter{.id = "protocol", .title = "Grains and experiments", .blocks = {}};
  if (!study.record) return chapter;
  const dem::ConfigValue text = stated_in(study);
  const std::vector<std::string>& assumed = study.record->study.assumed;
  const Stated stated(&text, assumed);
  Table table{.name = "protocol",
              .title = {},
              .data = {.columns = {{.name = "item", .unit = {}},
                                   {.name = "stated in the study", .unit = {}},
                                   {.name = "assumed", .unit = {}},
                                   {.name = "measured", .unit = {}}},
                       .rows = {}}};
  add_materials(*study.record, stated, table);
  const Stated experiments = stated.section("experiment");
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    add_experiment(*study.record, entry, experiments.section(std::string(entry.name)), table);
  }
  chapter.blocks.push_back(std::move(table));
  add_films(*study.record, chapter);
  chapter.blocks.push_back(
      Paragraph{"These are the settings of the simulations. What is assumed was not measured: the "
                "study marks it, or does not state it. Where the bench was another, the "
                "coefficients make up for the difference."});
  if (!assumed.empty()) {
    chapter.blocks.push_back(Paragraph{shortened(
        fmt::format("Marked as assumed in the study: {}.", fmt::join(assumed, ", ")), 2000)});
  }
  return chapter;
}

namespace {

Table measured_table(const JointResult& joint) {
  Table table{.name = "measured",
              .title = "What was measured",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "mean", .unit = {}},
                                   {.name = "sd of single readings", .unit = {}},
                                   {.name = "standard uncertainty of the mean", .unit = {}},
                                   {.name = "use", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& one : joint.observables) {
    table.data.add({axis_of_observable(one.name, one.unit), cell(one.measured),
                    cell(one.measured_sd), cell(one.measured_uncertainty), std::string("fitted")});
  }
  for (const Prediction& one : joint.held_out) {
    table.data.add({axis_of_observable(one.name, one.unit), cell(one.measured), std::monostate{},
                    cell(one.measured_uncertainty), std::string("held out")});
  }
  return table;
}

}  // namespace

Chapter table_chapter(const StudyResult& result) {
  Chapter chapter{.id = "table", .title = "Measurements and runs", .blocks = {}};
  const auto* joint = std::get_if<JointResult>(&result.found);
  if (joint == nullptr || !result.provenance.table) return chapter;
  const TableFacts& table = *result.provenance.table;
  chapter.blocks.push_back(measured_table(*joint));
  chapter.blocks.push_back(Paragraph{shortened(
      fmt::format("The runs were made {}, and are the {} rows of {}: {} of them failed, {} have no "
                  "reading; {} more were left out. What the particles, walls and experiments of "
                  "these runs are, the table does not say.",
                  table.engine ? "by a command of the study" : "with another program", table.rows,
                  fmt::join(table.files, ", "), table.failed, table.without_reading,
                  table.left_out),
      1000)});
  return chapter;
}

}  // namespace repose::calibrate::report
