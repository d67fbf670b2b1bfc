#include "calibrate/runs/next_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "calibrate/fit/points.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/runs/table_fit.h"

namespace repose::calibrate {
namespace {

constexpr const char* kReason = "reason";

double distance2(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

double nearest2(const Point& point, const std::vector<Point>& others) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point& other : others) nearest = std::min(nearest, distance2(point, other));
  return nearest;
}

/// The place of an even spread that is farthest from all that there are.
Point farthest(const std::vector<Point>& others, std::size_t dimensions) {
  constexpr std::size_t kSpread = 512;
  Point best;
  double most = -1;
  for (std::size_t k = 0; k < kSpread; ++k) {
    Point point = sequence_point(k, dimensions);
    const double far = nearest2(point, others);
    if (far > most) {
      most = far;
      best = std::move(point);
    }
  }
  return best;
}

std::vector<Point> places_of(const Problem& problem, const TableRuns& table) {
  std::vector<Point> places;
  for (const std::vector<double>& values : table.places) places.push_back(to_unit(problem, values));
  return places;
}

/// Some place has several runs, or a mean of several: what chance does is told.
bool tells_chance(const TableRuns& table) {
  std::vector<std::vector<double>> places = table.places;
  std::ranges::sort(places);
  return std::ranges::adjacent_find(places) != places.end() ||
         std::ranges::any_of(table.runs, [](const Run& run) { return !run.repeat_sd.empty(); });
}

NextRuns spread_runs(const Problem& problem, const TableRuns& table, std::size_t count) {
  constexpr std::size_t kRepeatEvery = 6;
  std::vector<Point> places = places_of(problem, table);
  const bool repeats = !tells_chance(table);
  NextRuns next;
  for (std::size_t k = 0; k < count; ++k) {
    if (repeats && k % kRepeatEvery == kRepeatEvery - 1) {
      next.runs.push_back({next.runs.back().values,
                           "the row above once more, with another seed: tells what chance does "
                           "(leave it out where your program has none)"});
      continue;
    }
    const bool is_start = table.places.empty();
    places.push_back(is_start ? sequence_point(places.size(), problem.parameters.size())
                              : farthest(places, problem.parameters.size()));
    next.runs.push_back({to_values(problem, places.back()),
                         is_start ? "a start that fills the bounds evenly"
                                  : "far from all other runs: fills the bounds evenly"});
  }
  return next;
}

/// "aor is known to ± 1.1 deg from the runs here, to ± 1.5 deg on the bench": of the reading of
/// which least is known for what the bench tells.
std::string reason_at(const Problem& problem, const Solution& solution, const Point& point) {
  std::size_t most = 0;
  double fraction = -1;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const double here = solution.misfit.surrogate_variance_fraction(i, point);
    if (here <= fraction) continue;
    fraction = here;
    most = i;
  }
  const Observable& observable = problem.observables[most];
  const std::string unit = observable.unit.empty() ? "" : ' ' + observable.unit;
  return fmt::format(
      "may fit: {} is known to ± {:.2g}{} from the runs here, to ± {:.2g}{} on the bench",
      observable.name, solution.misfit.surrogates()[most].uncertainty(point), unit,
      solution.misfit.measured_uncertainty(most), unit);
}

/// What more runs would not do, the advice of the fit does.
std::vector<std::string> settled_text(const JointFit& fit, std::size_t chosen) {
  std::vector<std::string> lines = {fmt::format(
      "{} would narrow the answer: where parameters fit, the surfaces through the runs are known "
      "much better than the bench's means.",
      chosen == 0 ? "No further run" : fmt::format("No more than {} runs", chosen))};
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.advice.empty()) continue;
    lines.push_back(fmt::format("{}: {}", parameter.name, parameter.advice));
  }
  return lines;
}

NextRuns narrowing_runs(const Problem& problem, const TableRuns& table, std::size_t count) {
  const std::vector<Run> runs = in_order(problem, table.runs);
  const Solution solution = solve(problem, runs);
  const std::vector<Surrogate>& surrogates = solution.misfit.surrogates();
  std::vector<double> weights;
  bool is_known = true;
  for (std::size_t i = 0; i < surrogates.size(); ++i) {
    weights.push_back(solution.misfit.weight(i));
    is_known = is_known && unknown_fraction(solution.misfit, solution.sets, i) <= kKnownWell;
  }
  NextRuns next;
  if (is_known) {
    next.settled = settled_text(fit_of(problem, runs, solution, {}), 0);
    return next;
  }
  std::vector<Point> places = places_of(problem, table);
  const std::vector<Point> candidates = candidate_places(solution.sets);
  const std::size_t elsewhere = count / kSpreadEvery;
  for (const std::size_t chosen :
       best_places(surrogates, weights, candidates, count - elsewhere, kKnownWell)) {
    const Point& point = candidates[chosen];
    std::string reason = reason_at(problem, solution, point);
    if (nearest2(point, places) == 0) reason += "; once more, with another seed";
    places.push_back(point);
    next.runs.push_back({to_values(problem, point), std::move(reason)});
  }
  const bool is_cut = next.runs.size() < count - elsewhere;
  for (std::size_t k = 0; k < elsewhere && !is_cut; ++k) {
    places.push_back(farthest(places, problem.parameters.size()));
    next.runs.push_back({to_values(problem, places.back()),
                         "far from all other runs: shows whether anything else fits there"});
  }
  if (is_cut) {
    next.settled = settled_text(fit_of(problem, runs, solution, {}), next.runs.size());
  }
  return next;
}

}  // namespace

NextRuns next_runs(const TableStudy& study, const TableRuns& table, std::size_t count) {
  const Problem problem = problem_of(study, table);
  require_sound(problem);
  return too_few_places(problem, table).empty() ? narrowing_runs(problem, table, count)
                                                : spread_runs(problem, table, count);
}

Table next_runs_table(const TableStudy& study, const TableRuns& table,
                      const std::vector<NextRun>& runs) {
  Table next{.name = {},
             .columns = table.columns,
             .rows = {},
             .has_decimal_comma = table.has_decimal_comma,
             .delimiter = table.delimiter};
  std::vector<std::string>& columns = next.columns;
  if (columns.empty()) {
    for (const Parameter& parameter : study.parameters) columns.push_back(parameter.name);
    const std::vector<std::string> readings = readings_of(study);
    columns.insert(columns.end(), readings.begin(), readings.end());
  }
  if (std::ranges::find(columns, kReason) == columns.end()) columns.emplace_back(kReason);
  for (const NextRun& run : runs) {
    TableRow& row = next.rows.emplace_back();
    for (const std::string& column : columns) {
      const auto parameter = std::ranges::find(study.parameters, column, &Parameter::name);
      if (parameter != study.parameters.end()) {
        const auto j = static_cast<std::size_t>(parameter - study.parameters.begin());
        std::string number = fmt::format("{}", run.values[j]);
        if (table.has_decimal_comma) std::ranges::replace(number, '.', ',');
        row.cells.push_back(std::move(number));
      } else {
        row.cells.push_back(column == kReason ? run.reason : "");
      }
    }
  }
  return next;
}

}  // namespace repose::calibrate
