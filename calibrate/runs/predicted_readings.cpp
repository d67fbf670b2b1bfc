#include "calibrate/runs/predicted_readings.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/result/result.h"
#include "calibrate/runs/table_columns.h"
#include "calibrate/statistics/table/table.h"
#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_record.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestReadings = 3;  // to learn from, as in a fit

struct LearnedReading {
  const Observable* observable;
  Surrogate surrogate;
};

std::vector<LearnedReading> learned(const Problem& problem, const std::vector<Run>& runs) {
  std::vector<LearnedReading> all;
  base::Faults faults;
  for (const auto* observables : {&problem.observables, &problem.held_out}) {
    for (const Observable& observable : *observables) {
      const TrainingSet training_set = training_set_of(
          problem, experiment_named(problem, observable.experiment), observable.reading, runs);
      if (training_set.readings.size() < kFewestReadings) {
        faults.add(
            {.where = observable.name,
             .value = fmt::format("{} runs have a reading of it", training_set.readings.size()),
             .rule = fmt::format("{} at least", kFewestReadings),
             .fix = "make more runs."});
        continue;
      }
      all.push_back({&observable, Surrogate(training_set, {}, true)});
    }
  }
  faults.throw_if_any();
  return all;
}

ReadingAt reading_at(const LearnedReading& learned_reading, const Point& point) {
  const auto& [observable, learned_surrogate] = learned_reading;
  Surrogate surrogate = learned_surrogate;
  surrogate.inflate_near(point);
  const Expectation w = surrogate.at(point, false);
  const AsinhWarp& warp = surrogate.warp();
  const std::vector<double>& readings = surrogate.training_set().readings;
  // If no run was below 0, no prediction is.
  const double least =
      std::max(observable->least,
               std::ranges::min(readings) < 0 ? -std::numeric_limits<double>::infinity() : 0.);
  const auto readable = [&](double reading) {
    return std::clamp(reading, least, observable->most);
  };
  const auto between = [&](double sd, const auto& reading_of) {
    return Interval{readable(reading_of(w.mean - base::kNormal95 * sd)),
                    readable(reading_of(w.mean + base::kNormal95 * sd))};
  };
  // The noise is known from few runs, and so is the part of a single run's scatter it causes.
  const double run_sd = surrogate.few_runs_factor() * surrogate.run_sd();
  const AsinhWarp without_noise{warp.warp, 0};
  return {
      .name = observable->name,
      .unit = observable->unit,
      .value = readable(warp.expected(w.mean)),
      .interval = between(std::hypot(std::sqrt(w.variance), run_sd),
                          [&](double v) { return without_noise.expected(v); }),
      .mean_interval = between(std::sqrt(w.variance), [&](double v) { return warp.expected(v); })};
}

/// "particle_wall.restitution" for "contact.particle_wall.restitution".
std::string short_name_of(const std::string& name) {
  constexpr std::string_view kContact = "contact.";
  return name.starts_with(kContact) ? name.substr(kContact.size()) : name;
}

}  // namespace

KnownRuns known_runs_in(const fs::path& folder) {
  const StudyRecord record = read_study_record(folder);
  const auto result = read_result(folder);
  const JointResult* joint = result ? std::get_if<JointResult>(&result->found) : nullptr;
  if (joint == nullptr || !is_same_study(result->provenance.study, identity_of(record))) {
    base::refuse(folder, "contains no result of this study by the joint method",
                 "repose calibrate STUDY.toml first; it resumes.");
  }
  Problem problem = problem_of(record.study, record.grain, record.budget).problem;
  std::vector<Run> runs = in_order(problem, joint->runs);
  // What is held out was simulated for its prediction; these runs are not in the result.
  problem.held_out.clear();
  return {.problem = std::move(problem), .runs = std::move(runs)};
}

std::vector<std::vector<double>> places_in(const fs::path& file,
                                           const std::vector<Parameter>& parameters) {
  Table table = read_table(file);
  std::vector<WantedColumn> wanted;
  for (const Parameter& parameter : parameters) wanted.push_back({parameter.name});
  std::vector<std::string> notes;
  base::Faults no_units;  // parameters have none
  take_names_without_units(wanted, table, notes, no_units);
  std::vector<NumberColumn> columns;
  for (const Parameter& parameter : parameters) {
    const bool has_it = table.column(parameter.name).has_value();
    columns.push_back({.name = has_it ? parameter.name : short_name_of(parameter.name)});
  }
  const std::vector<std::vector<double>> numbers = numbers_of(table, columns);
  base::Faults outside(kMaxRowErrors);
  std::vector<std::vector<double>> places(table.rows.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const Parameter& parameter = parameters[j];
      const double value = numbers[j][k];
      outside.require(
          value >= parameter.min && value <= parameter.max,
          {.where = fmt::format("{}:{}", table.name, table.rows[k].line),
           .subject = parameter.name,
           .value = fmt::format("is {:g}", value),
           .rule = fmt::format("within the study's bounds, {:g} and {:g}: beyond them nothing is "
                               "known",
                               parameter.min, parameter.max),
           .fix = "another value; or widen the bounds, and make runs there."});
      places[k].push_back(value);
    }
  }
  outside.throw_if_any();
  return places;
}

std::vector<std::vector<ReadingAt>> predicted_readings(
    const KnownRuns& known, const std::vector<std::vector<double>>& places) {
  const std::vector<Run> runs = in_order(known.problem, known.runs);
  const std::vector<LearnedReading> all = learned(known.problem, runs);
  std::vector<std::vector<ReadingAt>> predicted;
  for (const std::vector<double>& values : places) {
    std::vector<ReadingAt>& here = predicted.emplace_back();
    for (const LearnedReading& one : all) {
      here.push_back(reading_at(one, to_unit(known.problem, values)));
    }
  }
  return predicted;
}

}  // namespace repose::calibrate
