#include "cli/statistics/bench_options.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/closest_word.h"
#include "base/input_error.h"
#include "calibrate/statistics/bench/sheet.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "dem/study/experiment_table.h"

namespace repose::cli {
namespace {

/// Readings from --set, by their names.
using Settings = std::map<std::string, std::vector<double>>;

Settings read_settings(const BenchArguments& arguments, const std::vector<std::string>& names,
                       BenchPlan& plan) {
  Settings settings;
  for (const std::string& text : arguments.settings) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const auto numbers = equals == std::string::npos
                             ? std::nullopt
                             : numbers_in(std::string_view(text).substr(equals + 1));
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      const std::string guess = base::closest_word(name, names);
      plan.errors.push_back(fmt::format(
          "--set {}: {} is not a reading of this test. {}Fix: {}.", text, name,
          guess.empty() ? "" : fmt::format("Did you mean {}? ", guess), fmt::join(names, ", ")));
    } else if (!settings.emplace(name, numbers.value_or(std::vector{0.0})).second) {
      plan.errors.push_back(
          fmt::format("--set {}: {} is set twice. Fix: set it once.", text, name));
    } else if (!numbers) {
      plan.errors.push_back(
          fmt::format("--set {}: must be a number, or several with commas between them. Fix: --set "
                      "{}=1.5 or --set {}=1.5,1.7.",
                      text, name, name));
    }
  }
  return settings;
}

/// Readings without a table: lists of the same length; a single value holds for all.
void add_typed_readings(const Settings& settings, const std::vector<std::string>& names,
                        BenchPlan& plan) {
  std::size_t count = 1;
  for (const auto& [name, values] : settings) count = std::max(count, values.size());
  for (const auto& [name, values] : settings) {
    if (values.size() == 1 || values.size() == count) continue;
    plan.errors.push_back(
        fmt::format("--set {}: has {} values, another reading has {}. Fix: give one for each "
                    "repeat, or a single one that holds for all.",
                    name, values.size(), count));
  }
  std::vector<std::string> missing;
  for (const std::string& name : names) {
    if (!settings.contains(name)) missing.push_back(name);
  }
  if (!missing.empty()) {
    plan.errors.push_back(fmt::format(
        "bench: readings are missing: {0}. Fix: name a CSV file with these columns, or --set "
        "{1}=VALUE,VALUE,...",
        fmt::join(missing, ", "), missing.front()));
  }
  if (!plan.errors.empty()) return;
  for (std::size_t i = 0; i < count; ++i) {
    calibrate::BenchReading reading{
        .place = fmt::format("reading {}", i + 1), .values = {}, .sample = {}};
    const auto value = [i](const std::vector<double>& values) {
      return values.size() == 1 ? values.front() : values[i];
    };
    for (const std::string& name : names) reading.values.push_back(value(settings.at(name)));
    for (const std::string& name : calibrate::optional_column_names(plan.test)) {
      const auto given = settings.find(name);
      if (given != settings.end()) reading.optional.emplace(name, value(given->second));
    }
    plan.readings.push_back(std::move(reading));
  }
}

/// What holds for all rows of a table; a list of values cannot.
std::map<std::string, double> constants_in(const Settings& settings, const std::string& file,
                                           BenchPlan& plan) {
  std::map<std::string, double> constants;
  for (const auto& [name, values] : settings) {
    constants[name] = values.front();
    if (values.size() == 1) continue;
    plan.errors.push_back(fmt::format(
        "--set {}: has {} values. Rule: beside a table, one that holds for all rows. Fix: make it "
        "a column of {}.",
        name, values.size(), file));
  }
  return constants;
}

/// A table's rows; columns that it lacks come from the settings.
void add_table_readings(const std::string& file, const Settings& settings, BenchPlan& plan) {
  base::Faults errors;
  calibrate::Sheet sheet = calibrate::read_sheet(
      file, plan.test, constants_in(settings, file, plan), calibrate::NoRows::refused, errors);
  for (calibrate::BenchReading& reading : sheet.readings) {
    plan.readings.push_back(std::move(reading));
  }
  for (const calibrate::LeftOut& one : sheet.left_out) {
    plan.notes.push_back(calibrate::text_of(one, file));
  }
  plan.notes.insert(plan.notes.end(), sheet.notes.begin(), sheet.notes.end());
  errors.throw_if_any();
}

/// Also where something else is wrong, to tell impossible readings at the same time.
void evaluate(BenchPlan& plan) {
  if (plan.readings.empty()) return;
  try {
    plan.result = calibrate::evaluate_bench(plan.test, plan.readings);
    plan.result.notes.insert(plan.result.notes.end(), plan.notes.begin(), plan.notes.end());
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
  }
}

/// An experiment's name stands for the test of its sheet: "drop" for "restitution".
std::string test_called(const std::string& name) {
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    if (entry.name == name) return std::string(entry.sheet.test);
  }
  return name;
}

}  // namespace

BenchPlan plan_bench(const BenchArguments& arguments) {
  BenchPlan plan;
  plan.json_file = arguments.json_file;
  const auto& tests = calibrate::kBenchTestNames;
  if (const auto test = read_word({"bench", test_called(arguments.test), plan.errors},
                                  {tests.begin(), tests.end()})) {
    plan.test = static_cast<calibrate::BenchTest>(*test);
    const std::vector<std::string> names = calibrate::column_names(plan.test);
    std::vector<std::string> known = names;
    for (std::string& name : calibrate::optional_column_names(plan.test)) {
      known.push_back(std::move(name));
    }
    const Settings settings = read_settings(arguments, known, plan);
    if (arguments.files.empty()) add_typed_readings(settings, names, plan);
    for (const std::string& file : arguments.files) {
      try {
        add_table_readings(file, settings, plan);
      } catch (const base::InputError& error) {
        add_faults(error, plan.errors);
      }
    }
  }
  evaluate(plan);
  check_output_places({json_place(plan.json_file, "\"equation\"")},
                      {arguments.files.begin(), arguments.files.end()}, plan.errors);
  return plan;
}

}  // namespace repose::cli
