#include "calibrate/fit/surrogate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

namespace {

auto order_of(const Run& run) {
  return std::tie(run.job.experiment, run.job.values, run.job.seed, run.job.inputs, run.failure,
                  run.readings, run.repeats, run.repeat_sd, run.reading_sd);
}

void require_of(const Problem& problem, const Run& run) {
  const Job& job = run.job;
  const bool known = std::any_of(problem.experiments.begin(), problem.experiments.end(),
                                 [&](const Experiment& e) { return e.name == job.experiment; });
  if (!known) {
    throw base::InputError(
        {.value = fmt::format("a run of \"{}\": no experiment is called so", job.experiment),
         .fix = "leave the run out"});
  }
  const bool numbers = std::all_of(job.values.begin(), job.values.end(),
                                   [](double value) { return std::isfinite(value); });
  if (job.values.size() != problem.parameters.size() || !numbers) {
    throw base::InputError(
        {.value =
             fmt::format("a run of {} with seed {}: has {} values, {}, for {} parameters",
                         job.experiment, job.seed, job.values.size(),
                         numbers ? "all numbers" : "some not numbers", problem.parameters.size()),
         .fix = "leave the run out"});
  }
  for (const auto& [name, reading] : run.readings) {
    if (!(std::abs(reading) > kMaxReading)) continue;
    throw base::InputError(
        {.value = fmt::format("a run of {} with seed {}: its reading \"{}\" is {:g}",
                              job.experiment, job.seed, name, reading),
         .rule = fmt::format("at most {:g}", kMaxReading),
         .fix = "leave the run out"});
  }
}

/// Larger differences between two runs are not rounding errors of the simulation.
constexpr double kAlike = 1e-9;  // of the reading, or of its unit if that is larger

bool is_alike(double one, double other) {
  return std::abs(one - other) <= kAlike * std::max({1., std::abs(one), std::abs(other)});
}

/// std::nullopt if there is no such number.
std::optional<double> reading_of(const Run& run, const std::string& name) {
  const auto found = run.readings.find(name);
  if (!run.failure.empty() || found == run.readings.end() || !std::isfinite(found->second)) {
    return std::nullopt;
  }
  return found->second;
}

/// In every reading that a bench could measure.
bool is_alike(const Experiment& experiment, const Run& one, const Run& other) {
  return std::ranges::all_of(experiment.measurable, [&](const std::string& name) {
    const std::optional<double> a = reading_of(one, name), b = reading_of(other, name);
    return a && b ? is_alike(*a, *b) : a.has_value() == b.has_value();
  });
}

}  // namespace

std::vector<Run> in_order(const Problem& problem, const std::vector<Run>& runs) {
  std::vector<Run> sorted = runs;
  for (const Run& run : sorted) require_of(problem, run);
  std::sort(sorted.begin(), sorted.end(),
            [](const Run& a, const Run& b) { return order_of(a) < order_of(b); });
  const auto same = [](const Run& a, const Run& b) { return a.job == b.job; };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
  return sorted;
}

namespace {

/// Whether the repeats behind a run's mean scatter. std::nullopt: not a mean, or not reported.
std::optional<bool> do_repeats_differ(const Experiment& experiment, const Run& run) {
  if (run.repeats < 2) return std::nullopt;
  std::optional<bool> differ;
  for (const std::string& name : experiment.measurable) {
    const auto sd = run.repeat_sd.find(name);
    const auto reading = reading_of(run, name);
    if (sd == run.repeat_sd.end() || !reading) continue;
    differ = differ.value_or(false) || !is_alike(*reading, *reading + sd->second);
  }
  return differ;
}

}  // namespace

bool has_chance(const Experiment& experiment, const std::vector<Run>& runs) {
  // A reading shared by all runs, as of grains that never leave, would say nothing about chance.
  constexpr std::size_t kFewest = 2;
  if (!experiment.is_stochastic) return false;
  std::set<double> repeated;
  const Run* first = nullptr;
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name) continue;
    if (const auto differ = do_repeats_differ(experiment, run)) {
      if (*differ) return true;
      if (const auto value = reading_of(run, "value")) repeated.insert(*value);
    }
    if (first == nullptr || first->job.values != run.job.values) {
      first = &run;
      continue;
    }
    if (!is_alike(experiment, *first, run)) return true;
    if (const auto value = reading_of(*first, "value")) repeated.insert(*value);
  }
  return repeated.size() < kFewest;
}

double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs) {
  if (experiment.scatter_within.empty() || reading != "value") return 0;
  double squares = 0;
  int count = 0;
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name || run.job.inputs != experiment.full) continue;
    const std::optional<double> sd = reading_of(run, experiment.scatter_within);
    if (!sd) continue;
    squares += *sd * *sd;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs) {
  TrainingSet training_set{.parameters = experiment.parameters,
                           .is_stochastic = has_chance(experiment, runs),
                           .places = {},
                           .readings = {},
                           .readings_per_run = experiment.readings_per_run,
                           .sd_within = sd_within(experiment, reading, runs)};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    const bool is_coarse = experiment.is_coarse(run.job.inputs);
    if (run.job.experiment != experiment.name) continue;
    if (!is_coarse && run.job.inputs != experiment.full) continue;
    const std::optional<double> value = reading_of(run, reading);
    if (!value) continue;
    Point place = seen_by(experiment, to_unit(problem, run.job.values));
    const bool is_repeat = !training_set.places.empty() && training_set.places.back() == place;
    if (is_repeat && !training_set.is_stochastic) continue;
    training_set.places.push_back(std::move(place));
    training_set.readings.push_back(*value);
    training_set.runs.push_back(k);
    const auto sd = run.repeat_sd.find(reading);
    training_set.repeats.push_back(run.repeats);
    training_set.repeat_sds.push_back(
        sd == run.repeat_sd.end() ? std::numeric_limits<double>::quiet_NaN() : sd->second);
    const auto own = run.reading_sd.find(reading);
    training_set.own_sds.push_back(own == run.reading_sd.end() ? 0 : own->second);
    training_set.kinds.push_back(is_coarse ? RunKind::coarse : RunKind::full);
  }
  if (std::ranges::count(training_set.kinds, RunKind::coarse) == 0) {
    training_set.kinds.clear();
  }
  if (std::ranges::all_of(training_set.own_sds, [](double sd) { return sd == 0; })) {
    training_set.own_sds.clear();
  }
  if (std::ranges::all_of(training_set.repeats, [](int repeats) { return repeats == 1; })) {
    training_set.repeats.clear();
    training_set.repeat_sds.clear();
  }
  return training_set;
}

int readings_among(const Experiment& experiment, const std::string& reading,
                   const std::vector<Run>& runs) {
  return static_cast<int>(std::ranges::count_if(runs, [&](const Run& run) {
    const bool is_used = run.job.inputs == experiment.full || experiment.is_coarse(run.job.inputs);
    return run.job.experiment == experiment.name && is_used && reading_of(run, reading);
  }));
}

std::size_t full_readings(const TrainingSet& training_set) {
  return training_set.readings.size() -
         static_cast<std::size_t>(std::ranges::count(training_set.kinds, RunKind::coarse));
}

int Attempts::failures() const {
  return static_cast<int>(std::count(failed.begin(), failed.end(), true));
}

Attempts attempts_of(const Problem& problem, const Experiment& experiment,
                     const std::vector<Run>& runs) {
  Attempts attempts{experiment.parameters, {}, {}};
  for (const Run& run : runs) {
    if (run.job.experiment != experiment.name) continue;
    // Larger grains may form no heap where the study's do, but not the other way round.
    if (run.job.inputs != experiment.full && !run.failure.empty()) continue;
    attempts.places.push_back(seen_by(experiment, to_unit(problem, run.job.values)));
    attempts.failed.push_back(!run.failure.empty());
  }
  return attempts;
}

namespace {

constexpr std::array<double, 4> kBends = {0, 1, .2, .04};  // times the readings' rms
constexpr std::size_t kEnoughToChoose = 100;               // runs used to choose a warp

double root_mean_square(const std::vector<double>& values) {
  const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

}  // namespace

double AsinhWarp::warped(double y) const { return warp > 0 ? std::asinh(y / warp) : y; }

double AsinhWarp::expected(double w) const {
  return warp > 0 ? warp * std::sinh(w) * std::exp(noise_sd * noise_sd / 2) : w;
}

double AsinhWarp::slope(double w) const {
  return warp > 0 ? warp * std::cosh(w) * std::exp(noise_sd * noise_sd / 2) : 1;
}

double AsinhWarp::of_expected(double y) const {
  return warp > 0 ? std::asinh(y / warp * std::exp(-noise_sd * noise_sd / 2)) : y;
}

double AsinhWarp::scatter(double w) const {
  if (warp <= 0 || noise_sd <= 0) return noise_sd;
  // E[sinh^2] = (exp(2 s^2) cosh(2w) - 1) / 2 for a normal argument of mean w and sd s.
  const double s2 = noise_sd * noise_sd;
  const double mean = std::sinh(w) * std::exp(s2 / 2);
  return warp *
         std::sqrt(std::max(0., (std::exp(2 * s2) * std::cosh(2 * w) - 1) / 2 - mean * mean));
}

Surrogate::Surrogate(const TrainingSet& training_set, const std::optional<Surrogate>& start,
                     bool thorough)
    : training_set_(training_set) {
  const auto [low, high] =
      std::minmax_element(training_set_.readings.begin(), training_set_.readings.end());
  if (*low == *high) return;
  std::optional<Hyperparameters> from;
  if (start && start->process_) from = start->process_->hyperparameters();
  warp_.warp = best_warp(from);
  process_ = learned(warp_.warp, from, thorough ? 2 : 1, 1);
  // If deterministic, the process' noise represents what its curve does not follow.
  if (training_set_.is_stochastic) warp_.noise_sd = process_->noise_sd();
  few_runs_factor_ = factor_of_few_runs();
}

double Surrogate::repeats_of(std::size_t reading) const {
  return training_set_.repeats.empty() ? 1 : training_set_.repeats[reading];
}

double Surrogate::runs_told(std::size_t reading) const {
  const bool is_told =
      !training_set_.repeat_sds.empty() && std::isfinite(training_set_.repeat_sds[reading]);
  return is_told ? repeats_of(reading) : 1;
}

/// The runs' own scatter has n - tr H degrees of freedom, where H maps their readings to those
/// expected at their places: 1 - H = N K^-1, N having noise^2 over the repeats on its diagonal. The
/// scatter of repeats about their mean adds more.
double Surrogate::factor_of_few_runs() const {
  if (!training_set_.is_stochastic) return 1;
  constexpr double kFewest = 3;  // fewer would reflect the prior of the noise more than the noise
  double df = 0;
  const std::vector<LeaveOneOut> all = process_->leave_one_out();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double noise = run_sd(training_set_.kind(i));
    df += noise * noise / (repeats_of(i) * all[i].sd * all[i].sd) + (runs_told(i) - 1);
  }
  return base::student_t_quantile(.975, std::max(df, kFewest)) / base::kNormal95;
}

GaussianProcess Surrogate::learned(double warp, const std::optional<Hyperparameters>& start,
                                   int starts, std::size_t every) const {
  std::vector<Point> places;
  std::vector<double> values;
  std::vector<RunKind> kinds;
  MeansOfRuns means;
  for (std::size_t i = 0; i < training_set_.places.size(); i += every) {
    kinds.push_back(training_set_.kind(i));
    const double reading = training_set_.readings[i];
    places.push_back(training_set_.places[i]);
    values.push_back(AsinhWarp{warp, 0}.warped(reading));
    // The warp is linear over the scatter of repeats and the uncertainty of a reading.
    const double slope = warp > 0 ? 1 / std::hypot(reading, warp) : 1;
    if (!training_set_.own_sds.empty()) {
      means.own_variances.push_back(std::pow(slope * training_set_.own_sds[i], 2));
    }
    if (training_set_.repeats.empty()) continue;
    means.counts.push_back(repeats_of(i));
    if (!training_set_.is_stochastic || runs_told(i) < 2) continue;
    means.df += runs_told(i) - 1;
    means.squares += (runs_told(i) - 1) * std::pow(slope * training_set_.repeat_sds[i], 2);
  }
  return {places, values, training_set_.is_stochastic, start, starts, means, kinds};
}

double Surrogate::best_warp(const std::optional<Hyperparameters>& start) const {
  const std::size_t every = 1 + (training_set_.places.size() - 1) / kEnoughToChoose;
  const double size = root_mean_square(training_set_.readings);
  double best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (const double fraction : kBends) {
    const double warp = fraction * size;
    // The density of y is that of w times dw/dy: Snelson, Rasmussen, Ghahramani (2004), Warped
    // Gaussian processes.
    double density = learned(warp, start, 1, every).log_posterior();
    for (std::size_t i = 0; warp > 0 && i < training_set_.readings.size(); i += every) {
      density -= runs_told(i) * std::log(std::hypot(training_set_.readings[i], warp));
    }
    if (density > most) {
      most = density;
      best = warp;
    }
  }
  return best;
}

Point Surrogate::seen(const Point& point) const {
  Point own;
  own.reserve(training_set_.parameters.size());
  for (const std::size_t i : training_set_.parameters) own.push_back(point[i]);
  return own;
}

Expectation Surrogate::at(const Point& point, bool with_gradients) const {
  Expectation all;
  if (with_gradients) {
    all.mean_gradient.assign(point.size(), 0);
    all.variance_gradient.assign(point.size(), 0);
  }
  if (!process_) {
    all.mean = training_set_.readings.front();
    return all;
  }
  const Expectation own = process_->at(seen(point), with_gradients);
  const double inflation2 = std::pow(inflation_ * few_runs_factor_, 2);
  all.mean = own.mean;
  all.variance = inflation2 * own.variance;
  for (std::size_t i = 0; with_gradients && i < training_set_.parameters.size(); ++i) {
    all.mean_gradient[training_set_.parameters[i]] = own.mean_gradient[i];
    all.variance_gradient[training_set_.parameters[i]] = inflation2 * own.variance_gradient[i];
  }
  return all;
}

double Surrogate::simulated(const Point& point) const {
  const double reading = warp_.expected(at(point, false).mean);
  return *std::min_element(training_set_.readings.begin(), training_set_.readings.end()) < 0
             ? reading
             : std::max(0., reading);
}

double Surrogate::uncertainty(const Point& point) const {
  const Expectation w = at(point, false);
  return warp_.slope(w.mean) * std::sqrt(w.variance);
}

double Surrogate::reading_sd(double w) const {
  return std::hypot(std::sqrt(training_set_.readings_per_run) * warp_.scatter(w),
                    training_set_.sd_within);
}

std::vector<double> Surrogate::covariance(const std::vector<Point>& points,
                                          const std::vector<RunKind>& kinds) const {
  if (!process_) return std::vector<double>(points.size() * points.size(), 0);
  std::vector<Point> places;
  for (const Point& point : points) places.push_back(seen(point));
  std::vector<double> all = process_->covariance(places, kinds);
  for (double& value : all) value *= std::pow(inflation_ * few_runs_factor_, 2);
  return all;
}

std::optional<CoarseShift> Surrogate::coarse_shift(const Point& point) const {
  if (!process_ || training_set_.kinds.empty()) return std::nullopt;
  const Expectation shift = process_->coarse_shift(seen(point));
  const double slope = warp_.slope(at(point, false).mean);
  return CoarseShift{slope * shift.mean,
                     slope * inflation_ * few_runs_factor_ * std::sqrt(shift.variance)};
}

void Surrogate::inflate_near(const Point& point) {
  if (!process_) return;
  const Point here = seen(point);
  const std::vector<double>& length = process_->hyperparameters().length;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < training_set_.places.size(); ++i) {
    double distance2 = 0;
    for (std::size_t c = 0; c < here.size(); ++c) {
      const double off = (training_set_.places[i][c] - here[c]) / length[c];
      distance2 += off * off;
    }
    order.emplace_back(distance2, i);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), std::max<std::size_t>(10, order.size() / 5)));
  const std::vector<LeaveOneOut> errors = process_->leave_one_out();
  std::vector<double> near;
  for (const auto& [distance2, i] : order) near.push_back(errors[i].error / errors[i].sd);
  inflation_ = std::max({1., leave_one_out_sigma(), root_mean_square(near)});
}

std::vector<double> Surrogate::standardised_errors() const {
  std::vector<double> standardised;
  if (!process_) return standardised;
  for (const LeaveOneOut& one : process_->leave_one_out()) {
    standardised.push_back(one.error / one.sd);
  }
  return standardised;
}

double Surrogate::leave_one_out_sigma() const {
  return process_ ? root_mean_square(standardised_errors()) : 0;
}

double Surrogate::leave_one_out_error() const {
  if (!process_) return 0;
  const std::vector<LeaveOneOut> errors = process_->leave_one_out();
  std::vector<double> misses;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double w = warp_.warped(training_set_.readings[i]) - errors[i].error;
    misses.push_back(training_set_.readings[i] - warp_.expected(w));
  }
  return root_mean_square(misses);
}

std::vector<double> Surrogate::length_scales() const {
  return process_ ? process_->hyperparameters().length : std::vector<double>{};
}

}  // namespace repose::calibrate
