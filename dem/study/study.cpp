#include "dem/study/study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/text.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/held_inputs.h"
#include "dem/study/read_contact.h"
#include "dem/study/read_experiments.h"
#include "dem/study/read_particle.h"
#include "dem/study/read_shared.h"

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestStudy_bytes = 1 << 20;

std::string study_text(const fs::path& file) {
  return base::read_whole_file(file, kLargestStudy_bytes);
}

/// A required section.
Section needed_section(Section& study, const std::string& key, const std::string& rule,
                       const std::string& example) {
  if (!study.has(key)) {
    study.errors().add({.file = study.place().file, .line = 1, .column = 1},
                       fmt::format("section [{}] is missing", key), rule, "add " + example);
  }
  return study.section(key);
}

}  // namespace

void read_heading(Section& section, StudyHeading& heading) {
  heading.title = section.text("title", "title = \"Soybeans on acrylic\"").value_or("");
  heading.author = section.text("author", "author = \"A. Smith\"").value_or("");
  heading.date = section.text("date", "date = \"23 November 2026\"").value_or("");
  heading.note = section.text("note", "note = \"harvest of 2024, 12 % moisture\"").value_or("");
}

namespace {

/// Names of all values of the study, such as "particle.density_kg_m3".
void add_names(const ConfigValue& table, const std::string& path, std::vector<std::string>& names) {
  for (const ConfigValue& value : table.items) {
    const std::string name = path.empty() ? value.name : path + '.' + value.name;
    names.push_back(name);
    if (value.kind == ConfigValue::Kind::table) add_names(value, name, names);
  }
}

/// Unknown names are errors: they would hide that a value is assumed.
void read_assumed(Section& section, const ConfigValue& root, std::vector<std::string>& assumed) {
  const std::string example = "assumed = [\"particle.density_kg_m3\"]";
  const ConfigValue* list = section.value("assumed");
  if (list != nullptr && list->kind == ConfigValue::Kind::array && list->items.empty()) return;
  const auto listed = section.texts("assumed", example);
  if (!listed || list == nullptr) return;
  std::vector<std::string> names;
  add_names(root, "", names);
  for (std::size_t k = 0; k < listed->size(); ++k) {
    const std::string& name = (*listed)[k];
    if (std::ranges::find(names, name) == names.end()) {
      const std::string close = base::closest_word(name, names);
      section.errors().add(
          list->items[k].place,
          fmt::format("{} names {}, which is not in this study", section.full("assumed"),
                      list->items[k].shown),
          "it lists values of this study that nobody has measured",
          close.empty() ? "take it out" : fmt::format("write {}, or take it out", close));
    } else if (std::ranges::find(assumed, name) == assumed.end()) {
      assumed.push_back(name);
    }
  }
}

void read_simulation(Section simulation, Study& study) {
  const auto fraction =
      simulation.number("timestep_fraction", from_to(.001, 1), "timestep_fraction = 1");
  study.model.timestep_fraction = fraction.value_or(study.model.timestep_fraction);
  study.model.timestep_s = simulation.number("timestep_s", above(0, 1), "timestep_s = 1e-5");
  if (simulation.has("timestep_fraction") && simulation.has("timestep_s")) {
    simulation.wrong(*simulation.value("timestep_s"), "timestep_fraction or timestep_s, not both",
                     "take one of them out");
  }
  constexpr std::int64_t kMaxReplicates = 100'000, kMaxThreads = 1024;
  if (const auto count = simulation.integer("replicates", 1, kMaxReplicates, "replicates = 5")) {
    study.replicates = static_cast<int>(*count);
  }
  if (const auto seed =
          simulation.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), "seed = 1")) {
    study.seed = static_cast<std::uint64_t>(*seed);
  }
  if (const auto threads = simulation.integer("threads", 1, kMaxThreads, "threads = 2")) {
    study.threads = static_cast<int>(*threads);
    study.model.threads = *study.threads;
  }
  simulation.reject_unknown_keys();
}

void read_sections(const ConfigValue& config, Section root, const NamedFiles& files, Study& study) {
  Section about = root.section("study");
  read_heading(about, study.heading);
  read_assumed(about, config, study.assumed);
  about.reject_unknown_keys();
  read_particle(needed_section(root, "particle", "a study has a particle",
                               "[particle] with size_mm = [22.5, 18.2, 17.5] (or scan, or clump), "
                               "density_kg_m3, young_modulus_pa and poisson_ratio"),
                files, study);
  read_wall(needed_section(root, "wall", "a study has walls",
                           "[wall] with young_modulus_pa = 2.1e11 and poisson_ratio = 0.3"),
            study);
  read_contact(needed_section(root, "contact", "a study has coefficients of contact",
                              "[contact.particle_wall] and [contact.particle_particle], each with "
                              "restitution, sliding_friction and rolling_friction"),
               study);
  const std::string sections =
      experiment_names({.is_meant = [](const ExperimentEntry& entry) { return entry.is_default; },
                        .before = "[experiment.",
                        .after = "]"});
  Section experiments = needed_section(root, "experiment", "at least one experiment is required",
                                       sections + "; all their keys have usual values");
  read_experiments(experiments, files, study);
  read_simulation(root.section("simulation"), study);
  read_uncertainty(root.section("uncertainty"), study);
  study.engine = read_engine(root.section("engine"));
  root.reject_unknown_keys();
}

/// Rejects a study of a table of runs, which has nothing to simulate.
void refuse_table(const ConfigValue& config, StudyErrors& errors) {
  const ConfigValue* parameters = config.find(kTableSection);
  if (parameters == nullptr) return;
  if (config.find("particle") != nullptr) {
    errors.add(parameters->place, "[parameter] stands beside [particle]",
               "a study is either simulated here, with [particle], or fitted to a table of runs "
               "of another program, with [parameter]",
               "take one of them out; in a study with [particle], coefficients get their bounds in "
               "[contact]");
  } else {
    errors.add(parameters->place,
               "[parameter] makes this a study of a table of runs: there is nothing to simulate",
               "its runs are made with another program",
               "give the table, repose calibrate STUDY.toml --runs runs.csv; or the command that "
               "makes runs, [engine] command = \"python3 run.py\"; or write [particle], [wall], "
               "[contact] and [experiment] in place of [parameter] and [measured]");
  }
  errors.throw_if_any();
}

Study read_text(const fs::path& file, const std::string& text,
                const std::vector<std::string>& settings, const NamedFiles& files) {
  StudyErrors errors;
  const ConfigValue config = parse_config(file.string(), text, settings, errors);
  errors.throw_if_any();  // in a half-read file, all other keys would be missing
  refuse_table(config, errors);
  Study study;
  study.file = file;
  read_sections(config, {&config, {}, {.file = file.string()}, errors}, files, study);
  errors.throw_if_any();
  return study;
}

/// "contact.particle_wall.restitution" and so on, for those without a value.
void add_open(const CoefficientSet& set, const std::string& pair, std::vector<std::string>& names) {
  for (const auto& [coefficient, name] : {std::pair(&set.restitution, "restitution"),
                                          {&set.sliding_friction, "sliding_friction"},
                                          {&set.rolling_friction, "rolling_friction"},
                                          {&set.restitution_exponent, "restitution_exponent"}}) {
    if (!coefficient->value) names.push_back(fmt::format("contact.{}.{}", pair, name));
  }
}

}  // namespace

Study read_study(const fs::path& file, const std::vector<std::string>& settings) {
  const std::string text = study_text(file);
  Study study = read_text(file, text, settings, {.folder = file.parent_path()});
  std::vector<std::string> parts = {text};
  parts.insert(parts.end(), settings.begin(), settings.end());
  for (const auto& shape : {study.grain.scan, study.grain.clump}) {
    if (shape) parts.push_back(base::read_whole_file(*shape));
  }
  for (const auto& [experiment, described] : study.experiments) {
    const auto& sheet = described.measured.sheet;
    if (sheet) parts.push_back(base::read_whole_file(*sheet));
  }
  study.hash = base::fingerprint(parts);
  return study;
}

Study read_study_copy(const fs::path& file, const std::vector<std::string>& settings) {
  return read_text(file, study_text(file), settings,
                   {.folder = file.parent_path(), .must_exist = false});
}

std::vector<std::filesystem::path> files_of(const Study& study) {
  std::vector<std::filesystem::path> files = {study.file};
  for (const auto& named : {study.grain.scan, study.grain.clump}) {
    if (named) files.push_back(*named);
  }
  for (const auto& [experiment, described] : study.experiments) {
    const Measured& measured = described.measured;
    if (measured.sheet) files.push_back(*measured.sheet);
    for (const auto* named : {&measured.pictures, &measured.videos, &measured.scans}) {
      files.insert(files.end(), named->begin(), named->end());
    }
  }
  return files;
}

bool has_protocol(const Study& study, Experiment experiment) {
  return study.experiments.contains(experiment);
}

Measured measured_in(const Study& study, Experiment experiment) {
  const auto found = study.experiments.find(experiment);
  return found == study.experiments.end() ? Measured{} : found->second.measured;
}

std::vector<std::string> open_coefficients(const Study& study, Experiment experiment) {
  std::vector<std::string> names;
  add_open(study.particle_wall, "particle_wall", names);
  if (has_grain_contacts(experiment)) {
    add_open(study.particle_particle, "particle_particle", names);
  }
  for (const WallPart part : experiment->parts) {
    const auto found = study.particle_parts.find(part);
    if (found != study.particle_parts.end()) {
      add_open(found->second, "particle_" + name_of(part), names);
    }
  }
  return names;
}

Model model_for(const Study& study, Experiment experiment) {
  Model model = study.model;
  const auto described = study.experiments.find(experiment);
  if (described != study.experiments.end()) {
    model.stiffness_factor = described->second.stiffness_factor;
  }
  const ExperimentEntry& entry = *experiment;
  if (!entry.is_bulk) model.size_cv = 0;
  std::erase_if(model.parts, [&entry](const auto& one) {
    return std::ranges::find(entry.parts, one.first) == entry.parts.end();
  });
  if (!has_grain_contacts(experiment)) {
    const auto close = [](double& open, double value) {
      if (std::isnan(open)) open = value;
    };
    close(model.grain_grain.restitution, model.grain_wall.restitution);
    close(model.grain_grain.sliding_friction, model.grain_wall.sliding_friction);
    close(model.grain_grain.rolling_friction, model.grain_wall.rolling_friction);
    model.grain_grain.restitution_exponent = 0;
  }
  return model;
}

}  // namespace repose::dem
