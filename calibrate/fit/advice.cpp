#include "calibrate/fit/advice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

namespace {

constexpr double kHour_s = 3600;

/// A measured mean at the plausible sets, in the units of its surrogate.
struct Seen {
  Eigen::VectorXd expected;  ///< at each of the plausible sets
  double bench2 = 0;         ///< variance of the measured mean by the scatter of its readings
  double lasting2 = 0;       ///< and from their common part and the model's error
  double surrogate2 = 0;     ///< of what the surrogate expects
};

Seen seen(const Solution& solution, std::size_t observable) {
  const std::vector<Point>& points = solution.sets.points;
  const auto count = static_cast<double>(points.size());
  Seen seen{.expected = Eigen::VectorXd(static_cast<Eigen::Index>(points.size())),
            .lasting2 = solution.misfit.lasting_variance(observable)};
  seen.bench2 = 1 / solution.misfit.weight(observable) - seen.lasting2;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Expectation w = solution.misfit.surrogates()[observable].at(points[k], false);
    seen.expected[static_cast<Eigen::Index>(k)] = w.mean;
    seen.surrogate2 += w.variance / count;
  }
  return seen;
}

/// Subtracts the column means.
Eigen::MatrixXd centred(Eigen::MatrixXd columns) {
  columns.rowwise() -= columns.colwise().mean().eval();
  return columns;
}

Eigen::MatrixXd columns_of(const std::vector<Point>& points) {
  Eigen::MatrixXd columns(points.size(), points.front().size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t j = 0; j < points[k].size(); ++j) {
      columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = points[k][j];
    }
  }
  return centred(std::move(columns));
}

/// Fraction of each parameter's standard deviation that remains when the variance of every
/// observable falls from its present value to bench2 * `bench` + lasting2 + surrogate2 *
/// `surrogate`: as if it were measured once more, with the variance that makes up the difference.
std::vector<double> left_over(const Eigen::MatrixXd& parameters, const std::vector<Seen>& all,
                              double bench, double surrogate) {
  std::vector<double> more;
  Eigen::MatrixXd readings(parameters.rows(), 0);
  for (const Seen& one : all) {
    const double now = one.bench2 + one.lasting2 + one.surrogate2;
    const double then = one.bench2 * bench + one.lasting2 + one.surrogate2 * surrogate;
    if (!(then > 0) || !(now > then)) continue;
    more.push_back(now * then / (now - then));
    readings.conservativeResize(Eigen::NoChange, readings.cols() + 1);
    readings.rightCols(1) = one.expected;
  }
  std::vector<double> left(static_cast<std::size_t>(parameters.cols()), 1);
  if (more.empty()) return left;
  readings = centred(std::move(readings));
  const auto count = static_cast<double>(parameters.rows());
  Eigen::MatrixXd variance = readings.transpose() * readings / count;
  for (std::size_t i = 0; i < more.size(); ++i) {
    variance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += more[i];
  }
  const Eigen::MatrixXd shared = parameters.transpose() * readings / count;
  const Eigen::MatrixXd explained = shared * variance.ldlt().solve(shared.transpose());
  for (std::size_t j = 0; j < left.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double own = parameters.col(at).squaredNorm() / count;
    if (own > 0) left[j] = std::sqrt(std::clamp(1 - explained(at, at) / own, 0., 1.));
  }
  return left;
}

}  // namespace

std::vector<Narrowing> narrowing_of(const Solution& solution, double spent_s) {
  std::vector<Seen> all;
  for (std::size_t i = 0; i < solution.misfit.surrogates().size(); ++i) {
    if (!solution.misfit.surrogates()[i].constant()) all.push_back(seen(solution, i));
  }
  const Eigen::MatrixXd parameters = columns_of(solution.sets.points);
  // The variance of a mean falls as the number of its runs grows.
  const auto hour = left_over(parameters, all, 1, spent_s / (spent_s + kHour_s));
  const auto exact = left_over(parameters, all, 1, 0);
  const auto readings = left_over(parameters, all, 1. / kMoreReadings, 1);
  std::vector<Narrowing> narrowing;
  for (std::size_t j = 0; j < hour.size(); ++j) {
    narrowing.push_back({.hour = hour[j], .exact = exact[j], .readings = readings[j]});
  }
  return narrowing;
}

std::vector<double> narrowing_by_readings(const Solution& solution, std::size_t observable) {
  return left_over(columns_of(solution.sets.points), {seen(solution, observable)},
                   1. / kMoreReadings, 1);
}

namespace {

constexpr double kReadings = 10;        // number assumed for advised measurements
constexpr std::size_t kFewestRuns = 8;  // required to learn a reading

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

bool is_held_out(const Problem& problem, const std::string& experiment) {
  return std::ranges::any_of(problem.held_out,
                             [&](const Observable& o) { return o.experiment == experiment; });
}

bool depends(const Experiment& experiment, std::size_t parameter) {
  return std::find(experiment.parameters.begin(), experiment.parameters.end(), parameter) !=
         experiment.parameters.end();
}

/// `left`: fraction of its standard deviation that remains.
std::string worth_of(const std::string& what, double left) {
  return fmt::format(
      "{} would reduce the uncertainty of this coefficient to about {:.0f} % of its present value",
      what, 100 * left);
}

std::string worth_of_ten(double fraction) {
  return worth_of("ten readings", std::sqrt(1 - fraction));
}

}  // namespace

Advisor::Advisor(const Problem& problem, const std::vector<Run>& runs, const Solution& solution,
                 std::vector<double> exact)
    : problem_(problem), solution_(solution), exact_(std::move(exact)) {
  for (const Experiment& experiment : measured_experiments(problem)) {
    for (const std::string& reading : experiment.measurable) {
      if (!is_measured(problem, experiment.name, reading)) {
        learn_unmeasured(experiment, reading, runs, unmeasured_);
      }
    }
  }
  for (const Offer& offer : problem.offers) {
    const auto is_failed = [](const Run& run) { return !run.failure.empty(); };
    const auto failed = std::ranges::count_if(offer.runs, is_failed);
    if (2 * failed > std::ssize(offer.runs)) continue;  // it mostly gives no reading: no advice
    learn_unmeasured(offer.experiment, "value", offer.runs, offered_);
  }
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    more_readings_.push_back(narrowing_by_readings(solution, i));
  }
}

void Advisor::learn_unmeasured(const Experiment& experiment, const std::string& reading,
                               const std::vector<Run>& runs, std::vector<Unmeasured>& all) const {
  const TrainingSet training_set = training_set_of(problem_, experiment, reading, runs);
  if (training_set.readings.size() < kFewestRuns) return;
  const Surrogate surrogate(training_set, {}, false);
  if (surrogate.constant()) return;
  Unmeasured unmeasured{.experiment = experiment.name, .reading = reading};
  Measurement& of_ten = unmeasured.of_ten;
  for (const Point& point : solution_.sets.points) {
    const Expectation w = surrogate.at(point, false);
    const double slope = surrogate.warp().slope(w.mean);
    of_ten.readings.push_back(surrogate.warp().expected(w.mean));
    of_ten.noise2 +=
        slope * slope * w.variance + std::pow(surrogate.reading_sd(w.mean), 2) / kReadings;
    if (reading == "value") {
      of_ten.noise2 += std::pow(experiment.systematic_fraction * of_ten.readings.back(), 2) +
                       std::pow(experiment.systematic_sd, 2);
    }
    of_ten.noise2 += std::pow(experiment.model_fraction * of_ten.readings.back(), 2);
  }
  of_ten.noise2 /= static_cast<double>(solution_.sets.points.size());
  all.push_back(std::move(unmeasured));
}

double Advisor::fraction_explained(const Measurement& measurement, std::size_t parameter) const {
  // Linear Bayes: measuring r with error variance v removes cov(r, x)^2 / (var r + v) from var x.
  // Goldstein and Wooff (2007), Bayes Linear Statistics.
  const std::vector<Point>& points = solution_.sets.points;
  const auto count = static_cast<double>(points.size());
  const double mean_x = mean_of(points)[parameter];
  double mean_r = 0;
  for (const double r : measurement.readings) mean_r += r / count;
  double xx = 0;
  double rr = 0;
  double xr = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i][parameter] - mean_x;
    const double r = measurement.readings[i] - mean_r;
    xx += x * x / count;
    rr += r * r / count;
    xr += x * r / count;
  }
  const double all = xx * (rr + measurement.noise2);
  return all > 0 ? xr * xr / all : 0;
}

Advisor::Best Advisor::best_of(const std::vector<Unmeasured>& all, std::size_t parameter) const {
  Best best{.fraction = kWorthwhile};
  for (const Unmeasured& unmeasured : all) {
    const double fraction = fraction_explained(unmeasured.of_ten, parameter);
    if (fraction > best.fraction) best = {&unmeasured, fraction};
  }
  return best;
}

std::string Advisor::unmeasured_advice(std::size_t parameter) const {
  const Best best = best_of(unmeasured_, parameter);
  if (best.unmeasured == nullptr) return "";
  return fmt::format("also measure {} in the {} experiment: {}", best.unmeasured->reading,
                     best.unmeasured->experiment, worth_of_ten(best.fraction));
}

Advice Advisor::addition_advice(std::size_t parameter) const {
  const Best best = best_of(offered_, parameter);
  if (best.unmeasured != nullptr) {
    const std::string& name = best.unmeasured->experiment;
    const auto offer = std::ranges::find(problem_.offers, name,
                                         [](const Offer& one) { return one.experiment.name; });
    const std::string what =
        offer->heading.empty() ? fmt::format("[experiment.{}]", name) : offer->heading;
    return {
        fmt::format("add {} and its readings to the study: {}", what, worth_of_ten(best.fraction)),
        {name}};
  }
  const std::vector<std::string>& tellers = problem_.parameters[parameter].identified_by;
  const bool is_told = std::ranges::any_of(tellers, [&](const std::string& experiment) {
    return std::ranges::any_of(problem_.experiments,
                               [&](const Experiment& e) { return e.name == experiment; });
  });
  if (is_told || tellers.empty()) return {};
  return {
      fmt::format("run an experiment that isolates this coefficient: add [experiment.{}] and its "
                  "readings to the study",
                  fmt::join(tellers, "] or [experiment.")),
      tellers};
}

std::string Advisor::more_readings_advice(std::size_t parameter) const {
  const auto best = std::ranges::min_element(
      more_readings_, {}, [&](const std::vector<double>& left) { return left[parameter]; });
  const double left = (*best)[parameter];
  if (!is_worthwhile(left)) return "";
  const Observable& of =
      problem_.observables[static_cast<std::size_t>(best - more_readings_.begin())];
  return fmt::format("take more bench readings of {}: {}", of.name,
                     worth_of(fmt::format("{} in place of {}", kMoreReadings * of.n, of.n), left));
}

std::string Advisor::unmade_advice(std::size_t parameter) const {
  std::vector<std::string> parts;
  for (const Experiment& experiment : problem_.experiments) {
    if (is_measured(problem_, experiment.name) || !depends(experiment, parameter)) continue;
    parts.push_back(
        is_held_out(problem_, experiment.name)
            ? fmt::format("fit the {} experiment too, which is held out and depends on "
                          "it",
                          experiment.name)
            : fmt::format("do the {} experiment, which depends on it", experiment.name));
  }
  return fmt::format("{}", fmt::join(parts, "; or "));
}

std::string Advisor::more_runs_advice(std::size_t parameter) const {
  if (!is_worthwhile(exact_[parameter])) return "";
  return "simulate more: " + worth_of("means known exactly", exact_[parameter]);
}

Advice Advisor::advice(std::size_t parameter, bool is_bounded) const {
  Advice advice = addition_advice(parameter);
  std::vector<std::string> parts = {unmeasured_advice(parameter), more_readings_advice(parameter),
                                    unmade_advice(parameter), advice.text,
                                    more_runs_advice(parameter)};
  std::erase(parts, "");
  advice.text = fmt::format("{}", fmt::join(parts, "; or "));
  if (parts.empty()) {
    advice.text = is_bounded
                      ? "these experiments hardly narrow it further: use the interval, or say in "
                        "the study with useful_half_width what half-width is narrow enough"
                      : "not identifiable from these experiments: fix it to a literature value and "
                        "fit the others again, which then belong to it";
  }
  return advice;
}

}  // namespace repose::calibrate
