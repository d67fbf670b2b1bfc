#include "calibrate/fit/advice.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "calibrate/fit/training_set.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr double kReadings = 10;         // taken of what is advised
constexpr double kWorthwhile = .3;       // share of the variance that it takes away
constexpr std::size_t kFewest = 8;       // runs to learn a reading from
constexpr double kMostlySurrogate = .5;  // surrogate variance over measured
constexpr double kSeen = 2;              // sigma from bound to bound: less, and runs show nothing

bool is_measured(const Problem& problem, const std::string& experiment) {
  return std::any_of(problem.observables.begin(), problem.observables.end(),
                     [&](const Observable& o) { return o.experiment == experiment; });
}

bool is_measured(const Problem& problem, const std::string& experiment,
                 const std::string& reading) {
  return std::any_of(
      problem.observables.begin(), problem.observables.end(),
      [&](const Observable& o) { return o.experiment == experiment && o.reading == reading; });
}

bool depends(const Experiment& experiment, std::size_t parameter) {
  return std::find(experiment.parameters.begin(), experiment.parameters.end(), parameter) !=
         experiment.parameters.end();
}

}  // namespace

Advisor::Advisor(const Problem& problem, const std::vector<Run>& runs, const Solution& solution)
    : problem_(problem), solution_(solution) {
  for (const Experiment& experiment : measured_experiments(problem)) {
    for (const std::string& reading : experiment.measurable) {
      if (is_measured(problem, experiment.name, reading)) continue;
      const TrainingSet training_set = training_set_of(problem, experiment, reading, runs);
      if (training_set.readings.size() < kFewest) continue;
      const Surrogate surrogate(training_set, {}, false);
      if (surrogate.constant()) continue;
      Unmeasured unmeasured{experiment.name, reading, {}, 0};
      for (const Point& point : solution.sets.points) {
        const Expectation w = surrogate.at(point, false);
        const double slope = surrogate.warp().slope(w.mean);
        const double scatter = surrogate.warp().scatter(w.mean);
        unmeasured.readings.push_back(surrogate.warp().expected(w.mean));
        unmeasured.noise2 += slope * slope * w.variance +
                             scatter * scatter * experiment.readings_per_run / kReadings;
      }
      unmeasured.noise2 /= static_cast<double>(solution.sets.points.size());
      unmeasured_.push_back(std::move(unmeasured));
    }
  }
}

double Advisor::fraction_explained(const Unmeasured& unmeasured, std::size_t parameter) const {
  // Linear Bayes: measuring r with error variance v takes cov(r, x)^2 / (var r + v) from var x.
  // Goldstein and Wooff (2007), Bayes Linear Statistics.
  const std::vector<Point>& points = solution_.sets.points;
  const auto count = static_cast<double>(points.size());
  const double mean_x = mean_of(points)[parameter];
  double mean_r = 0;
  for (const double r : unmeasured.readings) mean_r += r / count;
  double xx = 0;
  double rr = 0;
  double xr = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i][parameter] - mean_x;
    const double r = unmeasured.readings[i] - mean_r;
    xx += x * x / count;
    rr += r * r / count;
    xr += x * r / count;
  }
  const double all = xx * (rr + unmeasured.noise2);
  return all > 0 ? xr * xr / all : 0;
}

bool Advisor::more_runs_would_help(std::size_t parameter) const {
  const Misfit& misfit = solution_.misfit;
  Point low = solution_.best.point;
  Point high = low;
  low[parameter] = 0;
  high[parameter] = 1;
  for (std::size_t i = 0; i < problem_.observables.size(); ++i) {
    const double effect = misfit.difference(i, high) - misfit.difference(i, low);
    if (std::abs(effect) > kSeen &&
        misfit.surrogate_variance_fraction(i, solution_.best.point) > kMostlySurrogate) {
      return true;
    }
  }
  return false;
}

std::string Advisor::advice(std::size_t parameter) const {
  std::string text;
  const Unmeasured* best = nullptr;
  double most = kWorthwhile;
  for (const Unmeasured& unmeasured : unmeasured_) {
    const double fraction = fraction_explained(unmeasured, parameter);
    if (fraction > most) {
      most = fraction;
      best = &unmeasured;
    }
  }
  if (best != nullptr) {
    text = fmt::format(
        "also measure {} in the {} experiment: ten readings would reduce the uncertainty of this "
        "coefficient to about {:.0f} % of its present value",
        best->reading, best->experiment, 100 * std::sqrt(1 - most));
  }
  for (const Experiment& experiment : problem_.experiments) {
    if (is_measured(problem_, experiment.name) || !depends(experiment, parameter)) continue;
    text += fmt::format("{}do the {} experiment, which depends on it", text.empty() ? "" : "; or ",
                        experiment.name);
  }
  if (more_runs_would_help(parameter)) {
    text += fmt::format("{}simulate more: the surrogates are less certain than the measurements",
                        text.empty() ? "" : "; or ");
  }
  if (text.empty()) {
    return "not identifiable from these experiments: fix it to a literature value, which will "
           "hardly affect them";
  }
  return text;
}

}  // namespace repose::calibrate
