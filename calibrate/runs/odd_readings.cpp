#include "calibrate/runs/odd_readings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/distributions.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kMostOdd = 3;       // of one reading
constexpr std::size_t kFewestOthers = 8;  // needed to compare a row with
constexpr double kSuspectSigmas = 2;      // standard deviations, while the surface includes it
constexpr double kOddSigmas = 6;          // and without it
constexpr double kOddOfRange = .25;

template <typename Value>
void erase_at(std::vector<Value>& values, std::size_t place) {
  if (!values.empty()) values.erase(values.begin() + static_cast<std::ptrdiff_t>(place));
}

TrainingSet without(TrainingSet set, std::size_t reading) {
  erase_at(set.places, reading);
  erase_at(set.readings, reading);
  erase_at(set.runs, reading);
  erase_at(set.repeats, reading);
  erase_at(set.repeat_sds, reading);
  erase_at(set.own_sds, reading);
  return set;
}

struct HeldReading {
  OddReading odd;
  bool is_far = false;
};

/// Compares a reading with the surface through the others.
HeldReading held_against(const Surrogate& others, const Point& place, double value) {
  const Expectation w = others.at(place, false);
  const double sd = std::hypot(std::sqrt(w.variance), others.few_runs_factor() * others.run_sd());
  const AsinhWarp straight{others.warp().warp, 0};
  const auto& readings = others.training_set().readings;
  const auto [least, most] = std::ranges::minmax(readings);
  HeldReading held{.odd = {.where = {},
                           .name = {},
                           .value = value,
                           .expected = {straight.expected(w.mean - base::kNormal95 * sd),
                                        straight.expected(w.mean + base::kNormal95 * sd)}}};
  held.is_far = std::abs(straight.warped(value) - w.mean) > kOddSigmas * sd &&
                std::abs(value - straight.expected(w.mean)) > kOddOfRange * (most - least);
  return held;
}

/// The index of the reading that the surface fits worst; std::nullopt: it fits all.
std::optional<std::size_t> most_suspicious(const Surrogate& surrogate) {
  const std::vector<double> errors = surrogate.standardised_errors();
  if (errors.empty()) return std::nullopt;
  const auto size = [](double error) { return std::abs(error); };
  const auto worst = std::ranges::max_element(errors, {}, size);
  if (std::abs(*worst) < kSuspectSigmas) return std::nullopt;
  return static_cast<std::size_t>(worst - errors.begin());
}

std::vector<OddReading> odd_among(const TrainingSet& all, const std::vector<Run>& runs,
                                  const TableRuns& table, const std::string& name) {
  std::vector<OddReading> found;
  TrainingSet left = all;
  Surrogate surrogate(left, {}, false);
  std::size_t odd = 0;
  while (found.size() < kMostOdd && left.readings.size() > kFewestOthers) {
    const auto worst = most_suspicious(surrogate);
    if (!worst) break;
    const Point place = left.places[*worst];
    const double value = left.readings[*worst];
    const Run& run = runs[left.runs[*worst]];
    left = without(std::move(left), *worst);
    surrogate = Surrogate(left, {}, false);
    HeldReading held = held_against(surrogate, place, value);
    held.odd.name = name;
    const auto row = std::ranges::find(table.runs, run.job, &Run::job);
    held.odd.where = table.run_rows.at(static_cast<std::size_t>(row - table.runs.begin()));
    found.push_back(std::move(held.odd));
    if (held.is_far) odd = found.size();
  }
  found.resize(odd);
  return found;
}

}  // namespace

std::string OddReading::text() const {
  return fmt::format("{} = {:.6g} in {}, where the other rows expect {:.4g} to {:.4g}", name, value,
                     where, expected.low, expected.high);
}

std::vector<OddReading> odd_readings(const Problem& problem, const TableRuns& table) {
  const std::vector<Run> runs = in_order(problem, table.runs);
  std::vector<OddReading> odd;
  for (const Experiment& experiment : problem.experiments) {
    const TrainingSet training_set = training_set_of(problem, experiment, "value", runs);
    if (training_set.readings.size() <= kFewestOthers) continue;
    for (OddReading& one : odd_among(training_set, runs, table, experiment.name)) {
      odd.push_back(std::move(one));
    }
  }
  return odd;
}

}  // namespace repose::calibrate
