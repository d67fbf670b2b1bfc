#include "calibrate/runs/table_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/statistics/summary.h"
#include "calibrate/statistics/table/other_rows.h"
#include "calibrate/statistics/table/table.h"
#include "calibrate/study/study_problem.h"
#include "dem/study/read_particle.h"
#include "dem/study/read_shared.h"
#include "dem/study/section.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using dem::ConfigValue;
using dem::Section;

constexpr std::uintmax_t kLargestStudy_bytes = 1 << 20;
constexpr double kMostMeasured = kMaxReading;
constexpr double kMostParameter = 1e15;  // a modulus in Pa is far below this
constexpr const char* kMeasuredSection = "measured";
constexpr const char* kMeasuredExample = "aor = { mean = 27, sd = 1.5, n = 10 }";
constexpr const char* kParameterExample = "sliding_friction = { min = 0.1, max = 0.6 }";

/// Tables are sorted by name; users expect the order of the file.
std::vector<const ConfigValue*> in_file_order(const ConfigValue& table) {
  std::vector<const ConfigValue*> items;
  for (const ConfigValue& item : table.items) items.push_back(&item);
  std::ranges::stable_sort(items, {}, [](const ConfigValue* one) {
    return std::tuple(one->place.setting, one->place.line, one->place.column);
  });
  return items;
}

/// A valid name for a column of a table.
bool is_name(const std::string& name) {
  return !name.empty() && name.front() != ' ' && name.back() != ' ' &&
         std::ranges::none_of(name, [](char letter) { return letter >= 0 && letter < ' '; });
}

class Reader {
 public:
  Reader(const ConfigValue& config, const fs::path& file, TableStudy& study)
      : files_{.folder = file.parent_path()},
        root_(&config, {}, {.file = file.string()}, errors_),
        study_(study) {}

  void read() {
    refuse_others();
    Section about = root_.section("study");
    dem::read_heading(about, study_.heading);
    about.reject_unknown_keys();
    read_items(
        dem::kTableSection, kParameterExample, "parameters to be found",
        [this](Section& section, const ConfigValue& item) { read_parameter(section, item); });
    read_items(kMeasuredSection, kMeasuredExample, "what a bench measured",
               [this](Section& section, const ConfigValue& item) { read_measured(section, item); });
    read_engine();
    root_.reject_unknown_keys();
    check_names();
    errors_.throw_if_any();
    faults_.throw_if_any();
    if (study_.measured.empty()) {
      base::refuse(study_.file, "all that was measured is held out, and nothing is left to fit",
                   "take held_out = true out of one of [measured].");
    }
  }

 private:
  /// Refuses sections of a study that is simulated.
  void refuse_others() {
    for (const char* key :
         {"particle", "wall", "contact", "experiment", "simulation", "uncertainty"}) {
      const ConfigValue* found = root_.value(key);
      if (found == nullptr) continue;
      errors_.add(found->place, fmt::format("[{}] stands beside [parameter]", key),
                  "a study of a table of runs has [study], [parameter], [measured] and [engine] "
                  "alone: what was simulated, the program that made the runs knows",
                  "take it out; or leave out [parameter] and --runs, for a study that repose "
                  "simulates itself");
    }
    errors_.throw_if_any();
  }

  template <typename Read>
  void read_items(const char* key, const char* example, const char* what, const Read& read) {
    const ConfigValue* table = root_.value(key);
    if (table == nullptr || table->items.empty()) {
      errors_.add({.file = root_.place().file, .line = 1, .column = 1},
                  fmt::format("section [{}] is missing or empty", key), what,
                  fmt::format("add [{}] with {}", key, example));
      return;
    }
    Section section = root_.section(key);
    for (const ConfigValue* item : in_file_order(*table)) {
      section.value(item->name);
      if (!is_name(item->name)) {
        section.wrong(*item, "a name that a column of a table can have", "rename it");
      } else if (item->kind != ConfigValue::Kind::table) {
        section.wrong(
            *item, fmt::format("as in {}", example),
            std::string(key) == kMeasuredSection
                ? "write mean, sd and n"
                : "write its bounds; a value that all runs have in common is no parameter");
      } else {
        read(section, *item);
      }
    }
  }

  void read_parameter(Section& section, const ConfigValue& item) {
    constexpr dem::Range kAny = dem::from_to(-kMostParameter, kMostParameter);
    dem::Coefficient coefficient;
    dem::read_bounds(section.section(item.name), item,
                     {.bounds = kAny, .mean = kAny, .widths = dem::above(0, kMostParameter)},
                     kParameterExample, false, coefficient);
    study_.parameters.push_back(sought_parameter(item.name, coefficient));
  }

  void read_measured(Section& section, const ConfigValue& item) {
    Section measured = section.section(item.name);
    check_ways(measured);
    Observable observable;
    observable.name = observable.experiment = item.name;
    observable.unit = measured.text("unit", "unit = \"deg\"").value_or("");
    if (observable.unit == "deg") {
      constexpr double kRightAngle_deg = 90;
      observable.least = 0;
      observable.most = kRightAngle_deg;
      study_.pictured[item.name] = read_pictured(measured);
    }
    read_mean(measured, observable);
    read_values(measured, observable);
    read_sheet(measured, observable);
    observable.tolerance =
        measured.number("tolerance", dem::above(0, kMostMeasured), "tolerance = 2");
    const auto bias =
        measured.number(dem::kBiasKey, dem::from_to(0, kMostMeasured), "bias_sd = 0.3");
    if (bias && *bias > 0) {
      observable.systematic_sd = *bias;
      observable.systematic.push_back({.name = dem::kBiasKey, .sd = *bias});
    }
    constexpr double kPercent = 100;
    const auto model_error = measured.number("model_error_percent", dem::from_to(0, kPercent),
                                             "model_error_percent = 3");
    observable.model_sd = model_error.value_or(0) / kPercent * std::abs(observable.mean);
    const bool is_held_out = measured.truth("held_out", "held_out = true").value_or(false);
    measured.reject_unknown_keys();
    (is_held_out ? study_.held_out : study_.measured).push_back(std::move(observable));
  }

  /// For an angle: how it is measured in pictures of runs.
  PicturedReading read_pictured(Section& measured) {
    PicturedReading pictured{.definition = dem::read_definition(measured), .placement = {}};
    const auto up = measured.text("up", "up = \"y\"");
    if (up) {
      const auto found = std::ranges::find(kUpNames, *up, &std::pair<std::string_view, Up>::first);
      if (found != kUpNames.end()) {
        pictured.placement.up = found->second;
      } else {
        measured.wrong(*measured.value("up"),
                       "the direction that is up is one of x, y, z, -x, -y "
                       "and -z",
                       "that of the files of particles");
      }
    }
    pictured.placement.plate = measured.number(
        "plate_height", dem::from_to(-kMostMeasured, kMostMeasured), "plate_height = 0");
    return pictured;
  }

  /// Exactly one way of stating the measurement is allowed.
  void check_ways(Section& measured) {
    for (const char* key : {"pictures", "videos", "scans"}) {
      const ConfigValue* found = measured.value(key);
      if (found == nullptr) continue;
      measured.wrong(*found, "in a study of a table of runs a measured number",
                     "measure them first: repose measure prints mean, sd and n of a folder of "
                     "heaps");
      return;
    }
    const auto ways = std::ranges::count_if(std::array{"values", "mean", "readings"},
                                            [&](const char* way) { return measured.has(way); });
    if (ways == 1) return;
    errors_.add(measured.place(),
                fmt::format("{} has {}", measured.path(),
                            ways == 0 ? "no values" : "more than one kind of values"),
                "values, or their mean, or a sheet of readings",
                std::string("for example ") + kMeasuredExample);
  }

  void read_mean(Section& measured, Observable& observable) {
    constexpr dem::Range kAny = dem::from_to(-kMostMeasured, kMostMeasured);
    const auto mean = measured.number("mean", kAny, "mean = 27");
    const auto sd = measured.number("sd", dem::above(0, kMostMeasured), "sd = 1.5");
    constexpr std::int64_t kMostReadings = 1'000'000;
    const auto n = measured.integer("n", 1, kMostReadings, "n = 10");
    for (const char* key : {"sd", "n"}) {
      if (!measured.has(key) || measured.has("mean")) continue;
      measured.wrong(*measured.value(key), "sd and n belong to a mean", "add mean or take it out");
    }
    if (!mean) return;
    if (!measured.has("sd")) {
      errors_.add(measured.place(), fmt::format("{} has a mean and no sd", measured.path()),
                  "a number with its uncertainty",
                  "add sd, that of single readings, and n, how many the mean is of; of one "
                  "reading the sd that such readings have elsewhere, and n = 1");
    }
    observable.mean = *mean;
    observable.sd = sd;
    observable.n = static_cast<int>(n.value_or(1));
    observable.is_sd_known = observable.n == 1;
    if (!measured.has("n")) {
      study_.notes.push_back(fmt::format(
          "{} does not say how many readings its mean is of: its sd, {:g}, is taken for the "
          "standard uncertainty of the mean, as of n = 1. Fix: n.",
          measured.path(), sd.value_or(0)));
    }
  }

  void take_readings(const Section& measured, const std::vector<double>& values,
                     Observable& observable) {
    if (values.size() < 2) {
      errors_.add(measured.place(), fmt::format("{} has one value", measured.path()),
                  "two values or more, which tell how they scatter",
                  "add others; or give mean, n = 1 and the sd that such readings have elsewhere");
      return;
    }
    const Summary summary = summarise(values);
    observable.mean = summary.mean;
    observable.sd = summary.sd;
    observable.n = summary.n;
    if (summary.sd > 0) return;
    errors_.add(measured.place(),
                fmt::format("{} has readings without any scatter", measured.path()),
                "readings differ", "give mean, n and as sd the resolution of the instrument");
  }

  void read_values(Section& measured, Observable& observable) {
    const auto values = measured.numbers("values", dem::from_to(-kMostMeasured, kMostMeasured),
                                         "values = [26.1, 27.9]");
    if (values) take_readings(measured, *values, observable);
  }

  /// Reads a table with a column of the reading's name, or with a single column.
  void read_sheet(Section& measured, Observable& observable) {
    const auto name = measured.text("readings", "readings = \"aor.csv\"");
    if (!name) return;
    const fs::path file = file_named(measured, *measured.value("readings"), *name, files_);
    if (!fs::exists(file)) return;  // already reported as an error
    study_.sheets.push_back(file);
    try {
      Table table = read_table(file);
      const std::string column =
          table.columns.size() == 1 ? table.columns.front() : observable.name;
      base::Faults wrong;
      const std::vector<std::string> columns = {column};
      const OtherRows other = take_other_rows(table, columns, Unlabelled::refused, wrong);
      for (const auto& [what, why] : other.left_out) {
        study_.notes.push_back(fmt::format("{}: {} is not used ({})", table.name, what, why));
      }
      study_.notes.insert(study_.notes.end(), other.notes.begin(), other.notes.end());
      wrong.throw_if_any();
      const std::vector<NumberColumn> numbers = {{.name = column}};
      take_readings(measured, numbers_of(table, numbers).front(), observable);
    } catch (const base::InputError& error) {
      faults_.add_all(error.faults());
    }
  }

  void read_engine() {
    Section engine = root_.section("engine");
    if (!engine.exists()) return;
    constexpr const char* kExample = "command = \"python3 run.py\"";
    constexpr double kLongest_s = 1e8;  // three years
    constexpr std::int64_t kMostRuns = 1000;
    EngineSettings& found = study_.engine.emplace();
    const auto command = engine.text("command", kExample);
    if (!engine.has("command")) {
      engine.missing("command", "what is started for each run", kExample);
    } else if (command && command->find_first_not_of(" \t\n") == std::string::npos) {
      engine.wrong(*engine.value("command"), "the line that starts the program of a run", kExample);
    }
    found.command = command.value_or("");
    found.timeout_s = engine.number("timeout_s", dem::above(0, kLongest_s), "timeout_s = 3600");
    const auto max_runs = engine.integer("max_runs", 1, kMostRuns, "max_runs = 40");
    if (max_runs) found.max_runs = static_cast<int>(*max_runs);
    const auto check_runs = engine.integer("check_runs", 0, kMostRuns, "check_runs = 6");
    if (check_runs) found.check_runs = static_cast<int>(*check_runs);
    if (const ConfigValue* settings = engine.value("settings")) {
      found.settings = *settings;
      if (settings->kind != ConfigValue::Kind::table) {
        engine.wrong(*settings, "a table, which the program gets as it is",
                     "as in settings = { grains = 500 }");
      }
    }
    engine.reject_unknown_keys();
  }

  /// A name must not be both a parameter and a reading.
  void check_names() {
    for (const std::string& reading : readings_of(study_)) {
      if (std::ranges::find(study_.parameters, reading, &Parameter::name) ==
          study_.parameters.end()) {
        continue;
      }
      errors_.add(root_.place(), fmt::format("{} is in [parameter] and in [measured]", reading),
                  "a column of the table is one of them", "rename one of them");
    }
  }

  dem::StudyErrors errors_;
  base::Faults faults_;
  dem::NamedFiles files_;
  Section root_;
  TableStudy& study_;
};

ConfigValue config_in(const fs::path& file, const std::string& text,
                      const std::vector<std::string>& settings) {
  dem::StudyErrors errors;
  ConfigValue config = dem::parse_config(file.string(), text, settings, errors);
  errors.throw_if_any();
  return config;
}

}  // namespace

bool is_table_study(const fs::path& file) {
  try {
    const ConfigValue config =
        config_in(file, base::read_whole_file(file, kLargestStudy_bytes), {});
    return config.find(dem::kTableSection) != nullptr && config.find("particle") == nullptr;
  } catch (const base::InputError&) {
    return false;
  }
}

TableStudy read_table_study(const fs::path& file, const std::vector<std::string>& settings) {
  TableStudy study;
  study.file = file;
  study.settings = settings;
  study.text = base::read_whole_file(file, kLargestStudy_bytes);
  const ConfigValue config = config_in(file, study.text, settings);
  if (config.find(dem::kTableSection) == nullptr) {
    base::refuse(
        file,
        "has no [parameter]: it is not a study of a table of runs, but one that repose "
        "simulates itself",
        std::string("repose calibrate without --runs fits it; or write [parameter] with ") +
            kParameterExample + " and [measured] with " + kMeasuredExample + '.');
  }
  Reader(config, file, study).read();
  return study;
}

dem::StudyHeading heading_of_table_study(const fs::path& file) {
  const ConfigValue config = config_in(file, base::read_whole_file(file, kLargestStudy_bytes), {});
  dem::StudyErrors ignored;
  Section root(&config, {}, {.file = file.string()}, ignored);
  Section about = root.section("study");
  dem::StudyHeading heading;
  dem::read_heading(about, heading);
  return heading;
}

std::vector<std::string> readings_of(const TableStudy& study) {
  std::vector<std::string> names;
  for (const auto* observables : {&study.measured, &study.held_out}) {
    for (const Observable& observable : *observables) names.push_back(observable.name);
  }
  return names;
}

}  // namespace repose::calibrate
