#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/predicted_readings.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "cli/runs/runs_commands.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The arguments of `repose predict`, as typed.
struct PredictArguments {
  std::string study;
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  std::string points;
  std::string json_file;
};

/// From a table, or from a study calibrated with simulations.
calibrate::KnownRuns known_runs(const PredictArguments& arguments) {
  if (!arguments.runs.empty()) {
    const calibrate::TableStudy study =
        calibrate::read_table_study(arguments.study, arguments.settings);
    const calibrate::TableRuns table =
        calibrate::read_table_runs(study, {arguments.runs.begin(), arguments.runs.end()});
    return {.problem = problem_of(study, table), .runs = table.runs, .notes = table.notes};
  }
  if (calibrate::is_table_study(arguments.study)) {
    base::refuse(arguments.study, "its runs are made with another program, and no table is given",
                 "repose predict STUDY.toml --runs runs.csv --at points.csv.");
  }
  if (!arguments.settings.empty()) {
    throw base::InputError({.value = "--set: the runs are those of the calibrated study, as it was",
                            .fix = "leave it out."});
  }
  std::error_code ignored;
  const fs::path folder = fs::is_directory(arguments.study, ignored)
                              ? fs::path(arguments.study)
                              : calibrate::default_folder(arguments.study);
  return calibrate::known_runs_in(folder);
}

Json interval_json(const calibrate::Interval& interval) {
  return Json::array({interval.low, interval.high});
}

std::string json_of(const calibrate::Problem& problem,
                    const std::vector<std::vector<double>>& places,
                    const std::vector<std::vector<calibrate::ReadingAt>>& readings) {
  constexpr int kIndent = 2;
  Json points = Json::array(), all = Json::array();
  for (std::size_t k = 0; k < places.size(); ++k) {
    Json at = Json::object();
    for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
      at[problem.parameters[j].name] = places[k][j];
    }
    Json point = Json::object();
    for (const calibrate::ReadingAt& one : readings[k]) {
      point[one.name] = {{"value", one.value},
                         {"interval", interval_json(one.interval)},
                         {"mean_interval", interval_json(one.mean_interval)},
                         {"unit", one.unit}};
    }
    points.push_back(std::move(point));
    all.push_back(std::move(at));
  }
  return Json{{"points", std::move(points)}, {"at", std::move(all)}}.dump(
             kIndent, ' ', false, Json::error_handler_t::replace) +
         '\n';
}

std::string table_of(const calibrate::Problem& problem,
                     const std::vector<std::vector<double>>& places,
                     const std::vector<std::vector<calibrate::ReadingAt>>& readings, int columns) {
  std::vector<Column> headings;
  for (const calibrate::Parameter& parameter : problem.parameters) {
    constexpr std::string_view kContact = "contact.";
    headings.push_back(number_column(parameter.name.starts_with(kContact)
                                         ? parameter.name.substr(kContact.size())
                                         : parameter.name));
  }
  headings.insert(headings.end(), {{.heading = "reading"},
                                   number_column("value"),
                                   {.heading = "95 %, one run"},
                                   {.heading = "95 %, mean of many"}});
  Table table(std::move(headings));
  const auto text_of = [](const calibrate::Interval& interval) {
    return fmt::format("{:.4g} … {:.4g}", interval.low, interval.high);
  };
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t i = 0; i < readings[k].size(); ++i) {
      const calibrate::ReadingAt& one = readings[k][i];
      std::vector<std::string> cells;
      for (const double value : places[k]) {
        cells.push_back(i == 0 ? fmt::format("{:.6g}", value) : "");
      }
      cells.push_back(one.unit.empty() ? one.name : fmt::format("{} [{}]", one.name, one.unit));
      cells.push_back(fmt::format("{:.4g}", one.value));
      cells.push_back(text_of(one.interval));
      cells.push_back(text_of(one.mean_interval));
      table.add_row(std::move(cells));
    }
  }
  Page page(columns);
  page.add(table);
  page.add_gap();
  page.add(
      "By surfaces through the runs that there are: nothing was simulated. One run: the interval "
      "of "
      "a single further run, its own chance included.");
  return page.text();
}

ExitCode run_predict(const PredictArguments& arguments) {
  std::vector<std::string> errors;
  std::vector<fs::path> read = {arguments.study, arguments.points};
  read.insert(read.end(), arguments.runs.begin(), arguments.runs.end());
  check_output_places({json_place(arguments.json_file, "\"points\"")}, read, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const calibrate::KnownRuns known = known_runs(arguments);
  const auto places = calibrate::places_in(arguments.points, known.problem.parameters);
  const auto readings = predicted_readings(known, places);
  print_lines(known.notes);
  Outputs outputs;
  outputs.add(arguments.json_file, json_of(known.problem, places, readings));
  outputs.show(table_of(known.problem, places, readings, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

constexpr const char* kPredictNotes = R"(
Predicts each reading at the parameters in the rows of POINTS.csv from surfaces
through existing runs; nothing is simulated. STUDY is one with [parameter], and
RUNS.csv the table of its runs; or, without --runs, a study that repose
calibrate has simulated: the runs are those in its folder, STUDY_calibration,
which can be given instead.

Each reading has two 95 % intervals: of one further run, and of the mean of very
many. Points outside the study's bounds are refused.

Examples:
  repose predict table.toml --runs runs.csv --at points.csv
  repose predict study.toml --at points.csv --json -
)";

}  // namespace

Command predict_command() {
  const auto given = std::make_shared<PredictArguments>();
  return {.name = "predict",
          .summary = "Predict readings at given parameters",
          .options = {{"study", "STUDY.toml", "Study file", &given->study, true},
                      {"--runs", "RUNS.csv", "Runs of another program; repeatable", &given->runs},
                      {"--at", "POINTS.csv", "A column for each parameter", &given->points, true},
                      {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                       &given->settings},
                      {"--json", "FILE|-", "The same, for programs", &given->json_file}},
          .notes = kPredictNotes,
          .missing =
              "a study and points are needed. Fix: repose predict STUDY.toml --runs runs.csv "
              "--at points.csv.",
          .run = [given] { return run_predict(*given); }};
}

}  // namespace repose::cli
