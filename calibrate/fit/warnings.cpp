#include "calibrate/fit/warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "base/distributions.h"
#include "calibrate/fit/advice.h"
#include "calibrate/fit/check_sample.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

namespace {

constexpr std::size_t kSpread = 512;
constexpr double kMatters = .05;  // of the reading's span: less does not count as a limit

}  // namespace

Extreme extreme_of(const Surrogate& surrogate, std::size_t dimensions, bool largest) {
  const double sign = largest ? 1 : -1;
  const auto height = [&](const Point& point) { return sign * surrogate.simulated(point); };
  Point best = sequence_point(0, dimensions);
  double most = height(best);
  double least = most;
  for (std::size_t i = 1; i < kSpread; ++i) {
    const Point point = sequence_point(i, dimensions);
    const double here = height(point);
    least = std::min(least, here);
    if (here > most) {
      most = here;
      best = point;
    }
  }
  for (double step = .5; step > .005; step /= 2) {
    for (std::size_t move = 0; move < 2 * dimensions; ++move) {
      Point point = best;
      double& x = point[move / 2];
      x = std::clamp(x + (move % 2 == 0 ? step : -step), 0., 1.);
      const double here = height(point);
      if (here > most) {
        most = here;
        best = point;
      }
    }
  }
  Extreme extreme{sign * most, surrogate.uncertainty(best), {}};
  for (std::size_t j = 0; j < dimensions; ++j) {
    if (best[j] > 0 && best[j] < 1) continue;
    Point inside = best;
    inside[j] = .5;
    if (most - height(inside) > kMatters * (most - least)) {
      extreme.limits.push_back({j, best[j] >= 1});
    }
  }
  return extreme;
}

namespace {

constexpr double kBeyond = 2;             // sigma; beyond it a target is out of reach
constexpr double kDoubtful = 1.5;         // inflation
constexpr double kHardlyNarrower = .9;    // than the prior's interval
constexpr double kSurrogateFraction = 1;  // of the measured variance
constexpr double kRare = .025;            // probability of so small a scatter

std::string limits_text(const Problem& problem, const Extreme& extreme) {
  std::string text;
  for (const Limit& limit : extreme.limits) {
    const Parameter& parameter = problem.parameters[limit.coordinate];
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", parameter.name,
                        limit.at_max ? parameter.max : parameter.min);
  }
  return text.empty() ? "no bound of a parameter" : text;
}

void warn_of_reach(const Problem& problem, const Solution& solution, std::size_t i,
                   const FittedObservable& fitted, std::vector<std::string>& warnings) {
  const Surrogate& surrogate = solution.misfit.surrogates()[i];
  if (surrogate.constant()) {
    warnings.push_back(fmt::format(
        "{}: every simulation gave {} {}, so it determines nothing. Fix: widen the bounds, "
        "or leave it out",
        fitted.name, fitted.simulated, fitted.unit));
    return;
  }
  const bool above = fitted.measured > fitted.reachable.high;
  if (!above && fitted.measured >= fitted.reachable.low) return;
  const Extreme extreme = extreme_of(surrogate, problem.parameters.size(), above);
  const double sigma = std::hypot(extreme.uncertainty, fitted.measured_uncertainty);
  if (std::abs(fitted.measured - extreme.reading) < kBeyond * sigma) return;
  warnings.push_back(fmt::format(
      "{}: the measured {:.4g} {} cannot be reached: within the bounds the simulation gives {:.4g} "
      "... {:.4g}, limited by {}. Fix: move that bound, or check the protocol",
      fitted.name, fitted.measured, fitted.unit, fitted.reachable.low, fitted.reachable.high,
      limits_text(problem, extreme)));
}

void warn_of_systematic(const Observable& observable, std::vector<std::string>& warnings) {
  for (const SystematicPart& part : observable.systematic) {
    if (!part.note.empty()) {
      warnings.push_back(fmt::format("{}: {}", observable.name, part.note));
    }
  }
}

void warn_of_scatter(const Observable& observable, const FittedObservable& fitted,
                     std::vector<std::string>& warnings) {
  if (!fitted.sd_assumed) return;
  const double assumed = 100 * *observable.assumed_sd_fraction;
  const bool is_by_chance = fitted.measured_sd > 1.001 * standard_uncertainty(observable) *
                                                     std::sqrt(static_cast<double>(observable.n));
  warnings.push_back(
      is_by_chance
          ? fmt::format(
                "{}: its scatter was not measured; assumed: sd {:.3g} {}, that of single readings "
                "in the simulation. Every interval depends on it. Fix: measure the scatter",
                fitted.name, fitted.measured_sd, fitted.unit)
          : fmt::format("{}: its scatter was not measured; assumed: sd {:.3g} % of the mean. Every "
                        "interval depends on it. Fix: measure the scatter",
                        fitted.name, assumed));
}

/// Warns when readings are more alike than chance in the simulation allows: their mean may be off
/// by more than their own scatter suggests. F test of two variances, one-sided. Proved by
/// JointFit.ReadingsThatAreMoreAlikeThanChanceAllowsAreNamed.
void warn_of_likeness(const Observable& observable, const FittedObservable& fitted, int runs,
                      std::vector<std::string>& warnings) {
  if (fitted.sd_assumed || !(fitted.predicted_sd > 0) || observable.n < 2 || runs < 2) return;
  const double ratio = fitted.measured_sd / fitted.predicted_sd;
  if (1 - base::fisher_f_above(ratio * ratio, observable.n - 1, runs - 1) > kRare) return;
  warnings.push_back(fmt::format(
      "{}: its {} readings have an sd of {:.3g} {}, single ones in the simulation {:.3g}: so "
      "little "
      "is rare by chance, and intervals may be too narrow. Fix: take more readings, each of other "
      "grains, and leave none out. Readings that are means, and simulated grains that scatter too "
      "much, look the same",
      fitted.name, observable.n, fitted.measured_sd, fitted.unit, fitted.predicted_sd));
}

/// Warns when an interval does not come from the measurements.
void warn_of_prior(const Parameter& parameter, const FittedParameter& fitted,
                   std::vector<std::string>& warnings) {
  const bool is_inside =
      fitted.verdict == Verdict::determined || fitted.verdict == Verdict::bounded;
  if (!parameter.prior || !is_inside) return;
  const double known = 2 * std::sqrt(kChi2Limit) * parameter.prior->sd;
  if (fitted.interval.high - fitted.interval.low < kHardlyNarrower * known) return;
  warnings.push_back(fmt::format(
      "{}: its interval is that of the prior; these measurements add almost nothing", fitted.name));
}

}  // namespace

std::vector<std::string> warnings_for(const Problem& problem, const Solution& solution,
                                      const JointFit& fit) {
  std::vector<std::string> warnings;
  const bool would_narrow =
      std::ranges::any_of(fit.parameters, [](const FittedParameter& parameter) {
        return parameter.narrowing && is_worthwhile(parameter.narrowing->exact);
      });
  for (std::size_t i = 0; i < fit.observables.size(); ++i) {
    const FittedObservable& fitted = fit.observables[i];
    const SurrogateQuality& quality = fit.surrogates[i];
    warn_of_reach(problem, solution, i, fitted, warnings);
    warn_of_systematic(problem.observables[i], warnings);
    warn_of_scatter(problem.observables[i], fitted, warnings);
    // Larger grains scatter more than the study's.
    if (quality.full_size == 1) {
      warn_of_likeness(problem.observables[i], fitted, quality.runs, warnings);
    }
    if (quality.inflation > kDoubtful) {
      warnings.push_back(fmt::format(
          "{}: the surrogate's errors were {:.1f} times its uncertainty, which was increased "
          "accordingly",
          fitted.name, quality.inflation));
    }
    if (quality.failed_runs > 0) {
      warnings.push_back(
          fmt::format("{}: {} of {} runs gave no reading; parameter sets near "
                      "them are considered unlikely",
                      fitted.name, quality.failed_runs, quality.failed_runs + quality.full_runs()));
    }
    if (would_narrow &&
        solution.misfit.surrogate_variance_fraction(i, solution.best.point) > kSurrogateFraction) {
      warnings.push_back(fmt::format(
          "{}: the simulations are less certain than the measurement: {} would narrow "
          "the intervals",
          fitted.name, problem.settings.are_runs_given ? "more runs" : "a larger budget"));
    }
  }
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    warn_of_prior(problem.parameters[j], fit.parameters[j], warnings);
  }
  // Below one degree of freedom there is next to nothing to test: the limit for one is used.
  const double of_chi2 = std::max(fit.freedom.of_chi2, 1.);
  const double chance = base::chi_square_above(fit.chi2, of_chi2);
  if (chance < kLevel) {
    std::string text = fmt::format(
        "no parameter set fits all measurements at once (chi-square {:.3g} of {:.2g} degrees of "
        "freedom, by chance in {:.2g} % of cases):",
        fit.chi2, of_chi2, 100 * chance);
    for (const FittedObservable& fitted : fit.observables) {
      text += fmt::format(" {} {:+.1f} sigma,", fitted.name, fitted.difference_sigma);
    }
    text.back() = '.';
    warnings.push_back(
        text +
        " The intervals are valid only if the model is. Fix: check readings, protocols "
        "and bounds");
  }
  return warnings;
}

}  // namespace repose::calibrate
