#include "calibrate/fit/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "calibrate/fit/advice.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/fit/warnings.h"

namespace repose::calibrate {

namespace {

constexpr std::size_t kCurvePlaces = 41;

constexpr std::size_t kSurfacePlaces = 25;  // along each side

double fraction(std::size_t place, std::size_t places) {
  return static_cast<double>(place) / static_cast<double>(places - 1);
}

std::vector<double> values_along(const Parameter& parameter, std::size_t places) {
  std::vector<double> values;
  for (std::size_t k = 0; k < places; ++k) {
    const double value = parameter.min + fraction(k, places) * (parameter.max - parameter.min);
    values.push_back(rounded(parameter, value));
  }
  return values;
}

const std::vector<std::size_t>& with_effect(const Problem& problem, std::size_t observable) {
  return experiment_named(problem, problem.observables[observable].experiment).parameters;
}

ResponseCurve curve_of(const Problem& problem, const Solution& solution, std::size_t observable,
                       std::size_t parameter) {
  const Surrogate& surrogate = solution.misfit.surrogates()[observable];
  ResponseCurve curve{.observable = observable,
                      .parameter = parameter,
                      .values = values_along(problem.parameters[parameter], kCurvePlaces),
                      .simulated = {},
                      .uncertainty = {},
                      .scatter = {}};
  Point point = solution.best.point;
  for (std::size_t k = 0; k < kCurvePlaces; ++k) {
    point[parameter] = fraction(k, kCurvePlaces);
    curve.simulated.push_back(surrogate.simulated(point));
    curve.uncertainty.push_back(surrogate.uncertainty(point));
    curve.scatter.push_back(surrogate.warp().scatter(surrogate.at(point, false).mean));
  }
  return curve;
}

ResponseSurface surface_of(const Problem& problem, const Solution& solution, std::size_t observable,
                           std::size_t x, std::size_t y) {
  const Surrogate& surrogate = solution.misfit.surrogates()[observable];
  ResponseSurface surface{.observable = observable,
                          .x_parameter = x,
                          .y_parameter = y,
                          .x = values_along(problem.parameters[x], kSurfacePlaces),
                          .y = values_along(problem.parameters[y], kSurfacePlaces),
                          .simulated = {}};
  Point point = solution.best.point;
  for (std::size_t row = 0; row < kSurfacePlaces; ++row) {
    point[y] = fraction(row, kSurfacePlaces);
    std::vector<double>& heights = surface.simulated.emplace_back();
    for (std::size_t column = 0; column < kSurfacePlaces; ++column) {
      point[x] = fraction(column, kSurfacePlaces);
      heights.push_back(surrogate.simulated(point));
    }
  }
  return surface;
}

/// Each observable along each parameter that its experiment depends on.
std::vector<ResponseCurve> response_curves(const Problem& problem, const Solution& solution) {
  std::vector<ResponseCurve> curves;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    for (const std::size_t parameter : with_effect(problem, i)) {
      curves.push_back(curve_of(problem, solution, i, parameter));
    }
  }
  return curves;
}

/// Each observable over each pair of such parameters.
std::vector<ResponseSurface> response_surfaces(const Problem& problem, const Solution& solution) {
  std::vector<ResponseSurface> surfaces;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const std::vector<std::size_t>& parameters = with_effect(problem, i);
    for (std::size_t x = 0; x < parameters.size(); ++x) {
      for (std::size_t y = x + 1; y < parameters.size(); ++y) {
        surfaces.push_back(surface_of(problem, solution, i, parameters[x], parameters[y]));
      }
    }
  }
  return surfaces;
}

constexpr double kReaches = .01;  // fraction of the box, from a bound
constexpr double kNearlyAll = .9;

Verdict verdict_of(const Parameter& parameter, const Profile& profile,
                   const FittedParameter& fitted) {
  const bool low = profile.low <= kReaches;
  const bool high = profile.high >= 1 - kReaches;
  if ((low && high) || profile.high - profile.low > kNearlyAll) return Verdict::undetermined;
  if (low || high) return Verdict::one_sided;
  const double half = (fitted.interval.high - fitted.interval.low) / 2;
  return leaves_one_value(parameter, fitted.value, half) ? Verdict::determined : Verdict::bounded;
}

FittedParameter parameter_of(const Problem& problem, const Solution& solution, std::size_t j) {
  const Parameter& parameter = problem.parameters[j];
  const Profile& profile = solution.profiles[j];
  const auto value_at = [&](double x) {
    return rounded(parameter, parameter.min + x * (parameter.max - parameter.min));
  };
  FittedParameter fitted;
  fitted.name = parameter.name;
  fitted.value = value_at(solution.best.point[j]);
  fitted.interval = {value_at(profile.low), value_at(profile.high)};
  fitted.verdict = verdict_of(parameter, profile, fitted);
  for (const Minimum& minimum : profile.minima) {
    fitted.profile.push_back(
        {value_at(minimum.point[j]),
         kChi2Limit / profile.rise * std::max(0., minimum.chi2 - solution.best.chi2)});
  }
  return fitted;
}

/// Core time, s.
double work_of(const Problem& problem, const std::vector<Run>& runs) {
  double seconds = 0;
  for (const Run& run : runs) {
    seconds += run_s_of(experiment_named(problem, run.job.experiment), run.job.inputs);
  }
  return seconds;
}

/// Adds the study lines of the experiments that are not among the additions yet.
void add_lines(const Problem& problem, const std::vector<std::string>& experiments,
               std::vector<StudyAddition>& additions) {
  for (const std::string& name : experiments) {
    const auto offer = std::ranges::find(problem.offers, name,
                                         [](const Offer& one) { return one.experiment.name; });
    if (offer == problem.offers.end()) continue;
    if (std::ranges::find(additions, name, &StudyAddition::experiment) != additions.end()) continue;
    additions.push_back({.experiment = name, .lines = offer->study_lines});
  }
}

void advise(const Problem& problem, const Advisor& advisor, JointFit& fit) {
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    if (fit.parameters[j].verdict == Verdict::determined) continue;
    const Advice advice = advisor.advice(j, fit.parameters[j].verdict == Verdict::bounded);
    fit.parameters[j].advice = advice.text;
    add_lines(problem, advice.experiments, fit.additions);
  }
}

FittedObservable observable_of(const Problem& problem, const Solution& solution, std::size_t i) {
  const Observable& observable = problem.observables[i];
  const Surrogate& surrogate = solution.misfit.surrogates()[i];
  const Point& best = solution.best.point;
  const std::size_t dimensions = problem.parameters.size();
  FittedObservable fitted;
  fitted.name = observable.name;
  fitted.unit = observable.unit;
  fitted.measured = observable.mean;
  fitted.measured_uncertainty = solution.misfit.measured_uncertainty(i);
  fitted.systematic_uncertainty = observable.systematic_sd;
  fitted.model_uncertainty = solution.misfit.model_scale() * observable.model_sd;
  const double by_scatter2 =
      std::pow(fitted.measured_uncertainty, 2) - std::pow(observable.systematic_sd, 2);
  fitted.measured_sd = std::sqrt(std::max(0., by_scatter2) * observable.n);
  fitted.sd_assumed = !observable.sd;
  fitted.simulated = surrogate.simulated(best);
  fitted.simulated_uncertainty = surrogate.uncertainty(best);
  const double w = surrogate.at(best, false).mean;
  fitted.simulated_sd = surrogate.warp().scatter(w);
  fitted.predicted_sd = surrogate.reading_sd(w);
  fitted.difference_sigma = solution.misfit.difference(i, best);
  const auto readable = [&](double reading) {
    return std::clamp(reading, observable.least, observable.most);
  };
  fitted.reachable = {readable(extreme_of(surrogate, dimensions, false).reading),
                      readable(extreme_of(surrogate, dimensions, true).reading)};
  return fitted;
}

PredictedSet predicted(const Problem& problem, const Solution& solution,
                       const std::vector<double>& values) {
  const Point point = to_unit(problem, values);
  PredictedSet set;
  set.values = values;
  set.chi2 = std::max(0., solution.misfit.chi2(point) - solution.best.chi2);
  for (const Surrogate& surrogate : solution.misfit.surrogates()) {
    set.simulated.push_back(surrogate.simulated(point));
  }
  return set;
}

int failed_coarse_runs(const Experiment& experiment, const std::vector<Run>& runs) {
  return static_cast<int>(std::ranges::count_if(runs, [&](const Run& run) {
    return run.job.experiment == experiment.name && experiment.is_coarse(run.job.inputs) &&
           !run.failure.empty();
  }));
}

SurrogateQuality quality_of(const Problem& problem, const std::vector<Run>& runs,
                            const Surrogate& surrogate, const Observable& observable,
                            const Point& best) {
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  SurrogateQuality quality;
  quality.observable = observable.name;
  quality.runs = readings_among(experiment, observable.reading, runs);
  quality.failed_runs = attempts_of(problem, experiment, runs).failures();
  quality.warp = surrogate.warp().warp;
  quality.length_scales = surrogate.length_scales();
  quality.leave_one_out_sigma = surrogate.leave_one_out_sigma();
  quality.leave_one_out_error = surrogate.leave_one_out_error();
  quality.inflation = surrogate.inflation();
  quality.full_size = experiment.full.size;
  if (const auto shift = surrogate.coarse_shift(best)) {
    const TrainingSet& training_set = surrogate.training_set();
    const std::size_t coarse = training_set.readings.size() - full_readings(training_set);
    quality.coarse = CoarseQuality{
        .size = experiment.usual_inputs().size,
        .runs = static_cast<int>(coarse),
        .failed_runs = failed_coarse_runs(experiment, runs),
        .shift = shift->value,
        .uncertainty = shift->uncertainty,
        .scatter = surrogate.run_sd(RunKind::coarse) / surrogate.run_sd(RunKind::full)};
  }
  return quality;
}

/// Of the plausible sets; 0 with a coordinate that does not vary.
std::vector<std::vector<double>> correlation_of(const std::vector<Point>& points) {
  const Point mean = mean_of(points);
  const Point sd = sd_of(points);
  std::vector<std::vector<double>> correlation(mean.size(), std::vector<double>(mean.size(), 0));
  for (std::size_t a = 0; a < mean.size(); ++a) {
    for (std::size_t b = 0; b < mean.size(); ++b) {
      double sum = 0;
      for (const Point& point : points) sum += (point[a] - mean[a]) * (point[b] - mean[b]);
      const double all = sd[a] * sd[b] * static_cast<double>(points.size());
      correlation[a][b] = a == b ? 1 : all > 0 ? sum / all : 0;
    }
  }
  return correlation;
}

/// Evenly spaced over all of them: neighbours may be copies of one that was resampled.
std::vector<std::vector<double>> drawn_from(const Problem& problem,
                                            const std::vector<Point>& points) {
  std::vector<std::vector<double>> drawn;
  for (std::size_t k = 0; k < kDrawnSets; ++k) {
    drawn.push_back(to_values(problem, points[(2 * k + 1) * points.size() / (2 * kDrawnSets)]));
  }
  return drawn;
}

}  // namespace

JointFit fit_jointly(const Problem& problem, const std::vector<Run>& runs,
                     const std::vector<std::vector<double>>& asked) {
  require_sound(problem);
  const std::vector<Run> sorted = in_order(problem, runs);
  return fit_of(problem, sorted, solve(problem, sorted), asked);
}

JointFit fit_of(const Problem& problem, const std::vector<Run>& runs, const Solution& solution,
                const std::vector<std::vector<double>>& asked) {
  JointFit fit;
  fit.chi2 = solution.stated_chi2;
  fit.freedom = solution.misfit.freedom(solution.best.point);
  fit.freedom.degrees = solution.stated_freedom.degrees;
  fit.freedom.of_chi2 = solution.stated_freedom.of_chi2;
  if (solution.misfit.has_model_errors()) fit.model_error_scale = solution.misfit.model_scale();
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    fit.parameters.push_back(parameter_of(problem, solution, j));
  }
  const std::vector<Narrowing> narrowing = narrowing_of(solution, work_of(problem, runs));
  std::vector<double> exact;
  for (std::size_t j = 0; j < narrowing.size(); ++j) {
    fit.parameters[j].narrowing = narrowing[j];
    exact.push_back(narrowing[j].exact);
  }
  advise(problem, Advisor(problem, runs, solution, std::move(exact)), fit);
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    fit.observables.push_back(observable_of(problem, solution, i));
    fit.surrogates.push_back(quality_of(problem, runs, solution.misfit.surrogates()[i],
                                        problem.observables[i], solution.best.point));
  }
  fit.correlation = correlation_of(solution.sets.points);
  fit.reading_correlation = solution.misfit.reading_correlation();
  fit.bench_correlation = solution.misfit.bench_correlation();
  for (const Minimum& member : equivalence_family(solution)) {
    fit.equivalence_family.push_back(
        {to_values(problem, member.point), std::max(0., member.chi2 - solution.best.chi2)});
  }
  for (const std::vector<double>& values : asked) {
    fit.asked.push_back(predicted(problem, solution, values));
  }
  fit.drawn = drawn_from(problem, solution.sets.points);
  fit.curves = response_curves(problem, solution);
  fit.surfaces = response_surfaces(problem, solution);
  fit.rounds = reconstruct_rounds(problem, runs).complete;
  fit.warnings = warnings_for(problem, solution, fit);
  return fit;
}

}  // namespace repose::calibrate
