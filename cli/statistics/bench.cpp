#include "cli/statistics/bench.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/bench/sheet.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {

namespace {

/// An evaluated `repose bench`, before its output.
struct BenchPlan {
  calibrate::BenchTest test = nullptr;  ///< null: unknown, see `errors`
  std::vector<calibrate::BenchReading> readings;
  calibrate::BenchResult result;
  std::string json_file;
  std::vector<std::string> notes;  ///< on the tables; the result has them too

  std::vector<std::string> errors;  ///< empty: it can be carried out
};

/// Readings from --set, by name.
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

/// Readings without a table: lists of the same length; a single value applies to all.
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

/// Values that apply to all rows of a table; lists are not allowed.
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

/// Evaluates even if there are other errors, to report impossible readings at the same time.
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

/// Reads all arguments and the tables they name, and evaluates them. Reports all errors at once.
BenchPlan plan_bench(const BenchArguments& arguments) {
  BenchPlan plan;
  plan.json_file = arguments.json_file;
  const std::vector<std::string> tests = calibrate::bench_test_names();
  if (const auto test = read_word({"bench", test_called(arguments.test), plan.errors}, tests)) {
    plan.test = calibrate::bench_test_named(tests[*test]);
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

using Json = nlohmann::ordered_json;

std::vector<std::string> quantity_row(const calibrate::BenchQuantity& quantity) {
  const auto& [n, mean, sd, uncertainty] = quantity.repeats;
  return {
      quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit),
      fmt::format("{:.4g}", mean), sd ? fmt::format("{:.3g}", *sd) : kMissing, fmt::format("{}", n),
      uncertainty ? fmt::format("{:.4g} … {:.4g}", mean - *uncertainty, mean + *uncertainty)
                  : kMissing};
}

/// For people: mean, scatter, interval of each quantity, and notes on them.
std::string bench_table(const std::string& test, const calibrate::BenchResult& result,
                        int columns) {
  Table table({{.heading = ""},
               number_column("mean"),
               number_column("sd"),
               number_column("n"),
               number_column("95 % interval of the mean (Student)")});
  for (const calibrate::BenchQuantity& quantity : result.quantities) {
    table.add_row(quantity_row(quantity));
  }
  Page page(columns);
  page.add(fmt::format("{}: {}", test, result.source));
  page.add_gap();
  page.add(table);
  page.add_gap();
  for (const std::string& note : result.notes) page.add(note);
  return page.text();
}

/// For programs. Missing numbers are null.
std::string bench_json(const std::string& test, const calibrate::BenchResult& result) {
  Json quantities = Json::array();
  for (const calibrate::BenchQuantity& quantity : result.quantities) {
    const auto& [n, mean, sd, uncertainty] = quantity.repeats;
    Json json{{"name", quantity.name},
              {"unit", quantity.unit},
              {"n", n},
              {"mean", mean},
              {"sd", nullptr},
              {"interval", nullptr},
              {"values", quantity.values}};
    if (sd) json["sd"] = *sd;
    if (uncertainty) json["interval"] = {mean - *uncertainty, mean + *uncertainty};
    quantities.push_back(std::move(json));
  }
  const Json json{{"test", test},
                  {"equation", result.source},
                  {"quantities", std::move(quantities)},
                  {"notes", result.notes}};
  constexpr int kNoteIndent = 2;
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

ExitCode run_bench(const BenchArguments& arguments) {
  const BenchPlan plan = plan_bench(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;

  Outputs outputs;
  const std::string test = calibrate::name_of(plan.test);
  outputs.add(plan.json_file, bench_json(test, plan.result));
  outputs.show(bench_table(test, plan.result, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
