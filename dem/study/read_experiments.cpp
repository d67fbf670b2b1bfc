#include "dem/study/read_experiments.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/angle_definition.h"
#include "base/file_set.h"
#include "base/text.h"
#include "dem/experiment/experiment_table.h"

namespace repose::dem {
namespace {

bool is_pictured(const ExperimentEntry& entry) { return entry.is_pictured; }
bool is_filmed(const ExperimentEntry& entry) { return entry.filmed != FilmedMotion::none; }
bool is_in_air(const ExperimentEntry& entry) { return entry.is_in_air; }

std::string measured_example() {
  return fmt::format(
      "measured = {{ values = [9.1, 9.6] }}, {{ mean = 9.42, sd = 0.5, n = 10 }}, {{ readings = "
      "\"drops.csv\" }} or, for a {}, {{ pictures = [\"photos\"] }}, or, for a {}, {{ videos = "
      "[\"films/*.mp4\"] }}",
      experiment_names({.is_meant = is_pictured}), experiment_names({.is_meant = is_filmed}));
}

/// Results must be given in exactly one way.
void check_ways(Section& measured) {
  int ways = 0;
  for (const char* way : {"values", "mean", "readings", "pictures", "videos", "scans"})
    ways += measured.has(way) ? 1 : 0;
  if (ways == 1) return;
  measured.errors().add(
      measured.place(),
      fmt::format("{} has {}", measured.path(),
                  ways == 0 ? "no values" : "more than one kind of values"),
      "values, or their mean, or a sheet of readings, or pictures, videos or scans",
      "for example " + measured_example());
}

/// How far bench and simulation may differ and still agree.
std::optional<double> read_tolerance(Section& measured) {
  return measured.number("tolerance", above(0, 1e6), "tolerance = 2");
}

/// The error common to all readings: of a ruler, the zero of a protractor, a density.
std::vector<Systematic> read_bias(Section& measured) {
  const auto sd = measured.number(kBiasKey, from_to(0, 1e6), "bias_sd = 0.3");
  if (!sd || *sd == 0) return {};
  return {{.name = kBiasKey, .sd = *sd}};
}

/// Files, folders and patterns beside the study file.
std::vector<std::filesystem::path> files_named(Section& measured, const std::string& key,
                                               const std::string& example,
                                               const NamedFiles& files) {
  std::vector<std::filesystem::path> found;
  const auto names = measured.texts(key, example);
  for (const std::string& name : names.value_or(std::vector<std::string>{})) {
    const std::filesystem::path path = files.folder / name;
    found.push_back(
        base::is_pattern(path) ? path : file_named(measured, *measured.value(key), name, files));
  }
  return found;
}

/// { heap = "a", files = ["a1.jpg", "a2.jpg"] }: pictures of one heap.
void read_pictures_of_heap(const Section& measured, const ConfigValue& item,
                           const NamedFiles& files, Measured& result) {
  Section group(&item, measured.full("pictures"), item.place, measured.errors());
  const auto heap = group.text("heap", "heap = \"a\"");
  const std::string example = "files = [\"a1.jpg\", \"a2.jpg\"]";
  if (!group.has("heap")) group.missing("heap", "a name for the heap", "heap = \"a\"");
  if (!group.has("files")) group.missing("files", "its pictures", example);
  const bool is_named = heap && !heap->empty();
  if (heap && !is_named) {
    group.wrong(*group.value("heap"), "a name for the heap", "for example heap = \"a\"");
  }
  if (is_named && std::ranges::find(result.picture_heaps, *heap) != result.picture_heaps.end()) {
    group.wrong(*group.value("heap"), "each heap once", "list all of its files together");
  }
  for (std::filesystem::path& path : files_named(group, "files", example, files)) {
    result.pictures.push_back(std::move(path));
    result.picture_heaps.push_back(heap.value_or(""));
  }
  group.reject_unknown_keys();
}

/// pictures = ["photos"], each of a different heap, or groups of several of one heap, or both.
void read_pictures(Section& measured, const NamedFiles& files, Measured& result) {
  const std::string key = "pictures";
  const ConfigValue* list = measured.value(key);
  const auto is_group = [](const ConfigValue& item) {
    return item.kind == ConfigValue::Kind::table;
  };
  if (list == nullptr || std::ranges::none_of(list->items, is_group)) {
    result.pictures = files_named(measured, key, "pictures = [\"photos\"]", files);
    return;
  }
  if (list->kind != ConfigValue::Kind::array) {
    measured.wrong(*list, "a list in brackets",
                   "for example pictures = [{ heap = \"a\", files = [\"a1.jpg\"] }]");
    return;
  }
  for (const ConfigValue& item : list->items) {
    if (is_group(item)) {
      read_pictures_of_heap(measured, item, files, result);
    } else if (item.kind != ConfigValue::Kind::text) {
      measured.wrong(*list, "texts in quotes and groups { heap, files }",
                     "for example pictures = [\"b.jpg\", { heap = \"a\", files = [\"a1.jpg\"] }]");
    } else {
      const std::filesystem::path path = files.folder / item.text;
      result.pictures.push_back(
          base::is_pattern(path) ? path : file_named(measured, item, item.text, files));
      result.picture_heaps.emplace_back();
    }
  }
}

/// Rejects pictures, films or scans of experiments that cannot be measured from them.
void check_medium(Section& measured, const std::string& key, bool (*is)(const ExperimentEntry&),
                  const ExperimentEntry& entry, const std::string& how) {
  if (is(entry) || !measured.has(key)) return;
  measured.wrong(*measured.value(key),
                 fmt::format("{}: {}, and not {}", how,
                             experiment_names({.is_meant = is, .last = ", "}), entry.name),
                 "give values, their mean or a sheet of readings");
}

Measured read_measured(Section& experiment, const ExperimentEntry& entry, const NamedFiles& files) {
  Measured result;
  Section measured = experiment.section("measured");
  if (!measured.exists()) return result;
  check_ways(measured);
  constexpr Range kAny = from_to(0, 1e6);
  result.values = measured.numbers("values", kAny, "values = [9.1, 9.6]").value_or(result.values);
  result.mean = measured.number("mean", kAny, "mean = 9.42");
  result.sd = measured.number("sd", kAny, "sd = 0.5");
  if (const auto n = measured.integer("n", 1, 1'000'000, "n = 10")) {
    result.count = static_cast<int>(*n);
  }
  result.tolerance = read_tolerance(measured);
  result.systematic = read_bias(measured);
  for (const char* key : {"sd", "n"}) {
    if (!measured.has(key) || measured.has("mean")) continue;
    measured.wrong(*measured.value(key), "sd and n belong to a mean", "add mean or take it out");
  }
  if (const auto name = measured.text("readings", "readings = \"drops.csv\"")) {
    result.sheet = file_named(measured, *measured.value("readings"), *name, files);
  }
  read_pictures(measured, files, result);
  check_medium(measured, "pictures", is_pictured, entry, "only this is measured in pictures");
  result.videos = files_named(measured, "videos", "videos = [\"drops/*.mp4\"]", files);
  check_medium(measured, "videos", is_filmed, entry, "only this is read off films");
  result.scans = files_named(measured, "scans", "scans = [\"heaps/*.ply\"]", files);
  check_medium(measured, "scans", is_pictured, entry, "only this is measured in scans");
  if (const auto in_air = measured.truth("in_air", "in_air = false")) {
    result.in_air = *in_air;
    if (!entry.is_in_air) {
      measured.wrong(*measured.value("in_air"),
                     fmt::format("only of {}, whose readings the drag of the air lowers",
                                 experiment_names({.is_meant = is_in_air, .last = ", "})),
                     "take this line out");
    }
  }
  measured.reject_unknown_keys();
  return result;
}

/// Adds an error if `value` has no effect without another key of the experiment.
void refuse_without(const Section& experiment, const ConfigValue& value, const std::string& name,
                    std::string_view needed) {
  if (needed.empty() || experiment.has(std::string(needed))) return;
  experiment.wrong(value, fmt::format("{} needs {}.{}", name, experiment.path(), needed),
                   fmt::format("add {}, or take it out", needed));
}

/// [experiment.heap.also_measured]: readings besides the experiment's own value.
void read_also(Section& experiment, const ExperimentEntry& entry, Measured& measured) {
  const auto is_measurable = [](const Reading& reading) { return reading.is_measurable; };
  if (std::ranges::none_of(entry.readings, is_measurable)) return;
  Section also = experiment.section("also_measured");
  for (const Reading& known : entry.readings) {
    if (!known.is_measurable) continue;
    const std::string name(known.name);
    Section reading = also.section(name);
    if (!reading.exists()) continue;
    refuse_without(experiment, *also.value(name), reading.path(), known.needs);
    constexpr Range kAny = from_to(-1e6, 1e6);
    MeasuredReading read{.name = name,
                         .mean = reading.needed_number("mean", kAny, "mean = 120"),
                         .sd = reading.number("sd", from_to(0, 1e6), "sd = 4"),
                         .count = {},
                         .tolerance = read_tolerance(reading),
                         .systematic = read_bias(reading)};
    if (const auto n = reading.integer("n", 1, 1'000'000, "n = 10")) {
      read.count = static_cast<int>(*n);
    }
    reading.reject_unknown_keys();
    measured.also.push_back(std::move(read));
  }
  also.reject_unknown_keys();
}

/// Overrides the protocol's value with that in the section, if any.
void read_key(Section& section, const ProtocolKey& key) {
  const std::string line = key.name + " = " + key.example;
  double* const* needed = std::get_if<double*>(&key.value);
  std::optional<double>* const* optional = std::get_if<std::optional<double>*>(&key.value);
  if (needed != nullptr || optional != nullptr) {
    const auto read = section.number(key.name, key.range, line);
    if (read && needed != nullptr) **needed = *read * key.unit;
    if (read && optional != nullptr) **optional = *read * key.unit;
    return;
  }
  const auto count = section.integer(key.name, static_cast<std::int64_t>(key.range.from),
                                     static_cast<std::int64_t>(key.range.to), line);
  if (!count) return;
  if (int* const* whole = std::get_if<int*>(&key.value)) {
    **whole = static_cast<int>(*count);
  } else {
    *std::get<std::optional<int>*>(key.value) = static_cast<int>(*count);
  }
}

void read_experiment(Section section, const ExperimentEntry& entry, const NamedFiles& files,
                     Study& study) {
  if (!section.exists()) return;
  StudyExperiment described{.protocol = entry.usual, .measured = {}};
  const std::vector<ProtocolKey> keys = entry.keys(described.protocol);
  for (const ProtocolKey& key : keys) read_key(section, key);
  for (const ProtocolKey& key : keys) {
    if (section.has(key.name)) {
      refuse_without(section, *section.value(key.name), section.full(key.name), key.needs);
    }
  }
  read_key(section,
           number_key("stiffness_factor", "0.01", above(0, 1), described.stiffness_factor));
  described.measured = read_measured(section, entry, files);
  read_also(section, entry, described.measured);
  if (entry.is_pictured) described.definition = read_definition(section);
  described.is_held_out = section.truth("held_out", "held_out = true").value_or(false);
  constexpr double kPercent = 100;
  const auto model_error =
      section.number("model_error_percent", from_to(0, kPercent), "model_error_percent = 3");
  if (model_error) described.model_error = *model_error / kPercent;
  section.reject_unknown_keys();
  study.experiments.emplace(&entry, std::move(described));
}

}  // namespace

void read_experiments(Section experiments, const NamedFiles& files, Study& study) {
  for (const ExperimentEntry& entry : all_experiments()) {
    read_experiment(experiments.section(std::string(entry.name)), entry, files, study);
  }
  experiments.reject_unknown_keys();
}

std::string read_definition(Section& section) {
  const std::string key = "definition";
  const auto name = section.text(key, "definition = \"whole_flank\"");
  if (!name || base::find_definition(*name) != nullptr) return name.value_or("");
  std::vector<std::string> known;
  for (const base::AngleDefinition& one : base::kAngleDefinitions) known.emplace_back(one.name);
  const std::string meant = base::closest_word(*name, known);
  section.wrong(*section.value(key),
                fmt::format("{} is one of {}", section.full(key), fmt::join(known, ", ")),
                meant.empty() ? "that by which the bench's angle was measured"
                              : fmt::format("did you mean \"{}\"?", meant));
  return {};
}

}  // namespace repose::dem
