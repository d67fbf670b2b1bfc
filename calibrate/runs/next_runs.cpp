#include "calibrate/runs/next_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "calibrate/fit/best_places.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"
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

/// If more of the runs nearby failed than gave a reading, the next one is likely to fail, too, or
/// one of several.
class LikelyFailures {
 public:
  LikelyFailures(const Problem& problem, const TableRuns& table)
      : risk_(attempts_in(problem, table)) {}

  bool any() const { return risk_.any(); }
  bool at(const Point& point) const {
    constexpr double kMost = .5;
    if (!risk_.any()) return false;
    double risk = risk_.at(point).fraction;
    for (const auto& [other, fraction] : asked_for_) {
      risk += fraction * risk_.nearness(point, other);
    }
    return risk > kMost;
  }
  /// Records a suggested run. Suggested runs near each other share the same risk: at most half a
  /// failure is expected among them.
  void expect(const Point& point) {
    if (risk_.any()) asked_for_.emplace_back(point, risk_.at(point).fraction);
  }

 private:
  static Attempts attempts_in(const Problem& problem, const TableRuns& table) {
    Attempts attempts;
    for (std::size_t j = 0; j < problem.parameters.size(); ++j) attempts.parameters.push_back(j);
    for (std::size_t k = 0; k < table.places.size(); ++k) {
      if (table.ends[k] == RowEnd::nothing) continue;
      attempts.places.push_back(to_unit(problem, table.places[k]));
      attempts.failed.push_back(table.ends[k] == RowEnd::failed);
    }
    return attempts;
  }

  FailureRisk risk_;
  std::vector<std::pair<Point, double>> asked_for_;  ///< with the risk of each
};

/// The place of an even spread that is farthest from all `others`, among those where runs are not
/// likely to fail; among all if they are likely to fail everywhere.
Point farthest(const std::vector<Point>& others, std::size_t dimensions,
               const LikelyFailures& failures) {
  constexpr std::size_t kSpread = 512;
  Point best;
  double most = -1;
  bool fails = true;
  for (std::size_t k = 0; k < kSpread; ++k) {
    Point point = sequence_point(k, dimensions);
    const double far = nearest2(point, others);
    const bool fails_here = failures.at(point);
    if (fails_here == fails ? far > most : fails) {
      most = far;
      fails = fails_here;
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

/// Whether some place has several runs, or a mean of several, which shows the random scatter.
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
  LikelyFailures failures(problem, table);
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
                              : farthest(places, problem.parameters.size(), failures));
    failures.expect(places.back());
    next.runs.push_back({to_values(problem, places.back()),
                         is_start ? "a start that fills the bounds evenly"
                                  : "far from all other runs: fills the bounds evenly"});
  }
  return next;
}

/// "may fit: aor is known to ± 1.1 deg from the runs here, to ± 1.5 deg on the bench": for the
/// reading whose surrogate is least certain relative to the bench.
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

/// What the advice of the fit suggests instead of more runs.
std::vector<std::string> settled_text(const JointFit& fit, std::size_t chosen,
                                      bool is_some_left_out) {
  std::vector<std::string> lines = {fmt::format(
      "{} would narrow the answer: where parameters fit{}, the surfaces through the runs are known "
      "much better than the bench's means.",
      chosen == 0 ? "No further run"
                  : fmt::format("No more than {} run{}", chosen, chosen == 1 ? "" : "s"),
      is_some_left_out ? " and runs are not likely to fail" : "")};
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.advice.empty()) continue;
    lines.push_back(fmt::format("{}: {}", parameter.name, parameter.advice));
  }
  return lines;
}

/// @return  fraction of the candidates removed, 0 to 1
double take_out_failures(const LikelyFailures& failures, std::vector<Point>& candidates) {
  const auto all = static_cast<double>(candidates.size());
  return static_cast<double>(std::erase_if(
             candidates, [&](const Point& candidate) { return failures.at(candidate); })) /
         all;
}

std::string left_out_text(double fraction) {
  if (fraction == 0) return {};
  return fmt::format(
      "No run is asked for in {:.0f} % of where the parameters may fit: more runs near there "
      "failed than gave a reading. If the parameters are not to blame, empty the cells that say "
      "so.",
      std::max(1., 100 * fraction));
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
    next.settled = settled_text(fit_of(problem, runs, solution, {}), 0, false);
    return next;
  }
  std::vector<Point> places = places_of(problem, table);
  std::vector<Point> candidates = candidate_places(solution.sets);
  LikelyFailures failures(problem, table);
  next.left_out = left_out_text(take_out_failures(failures, candidates));
  if (candidates.empty()) {
    next.settled = {"No further run would narrow the answer: where parameters fit, runs fail."};
    return next;
  }
  const std::size_t elsewhere = count / kSpreadEvery;
  bool is_kept_apart = false;
  const auto accepts = [&](std::size_t candidate) {
    if (failures.at(candidates[candidate])) {
      is_kept_apart = true;
      return false;
    }
    failures.expect(candidates[candidate]);
    return true;
  };
  for (const std::size_t chosen :
       best_places(surrogates, weights, candidates, count - elsewhere, kKnownWell, accepts)) {
    const Point& point = candidates[chosen];
    std::string reason = reason_at(problem, solution, point);
    if (nearest2(point, places) == 0) reason += "; once more, with another seed";
    places.push_back(point);
    next.runs.push_back({to_values(problem, point), std::move(reason)});
  }
  const bool is_cut = next.runs.size() < count - elsewhere;
  for (std::size_t k = 0; k < elsewhere && (!is_cut || is_kept_apart); ++k) {
    places.push_back(farthest(places, problem.parameters.size(), failures));
    failures.expect(places.back());
    next.runs.push_back({to_values(problem, places.back()),
                         "far from all other runs: shows whether anything else fits there"});
  }
  if (is_cut) {
    next.settled = is_kept_apart
                       ? std::vector<std::string>{fmt::format(
                             "No more than {} {} asked for at once: others would be near these, "
                             "where runs may fail. Once these were made, ask again.",
                             next.runs.size(), next.runs.size() == 1 ? "run is" : "runs are")}
                       : settled_text(fit_of(problem, runs, solution, {}), next.runs.size(),
                                      !next.left_out.empty());
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
