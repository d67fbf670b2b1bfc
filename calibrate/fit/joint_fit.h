#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/freedom.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// determined: the interval ends inside both bounds, and is narrow: its half-width is at most 25 %
/// of the value or what the study calls useful. bounded: it ends inside both bounds and is wider:
/// known to an interval, not to a value. one_sided: it reaches one of them. undetermined: it
/// reaches both, or covers nearly all between them.
enum class Verdict { determined, bounded, one_sided, undetermined };

struct Interval {
  double low = 0;
  double high = 0;
};

/// The best fit with one parameter held at `value`.
struct ProfilePoint {
  double value = 0;
  /// Above that of the best fit, in units of which 3.84 end the interval: the rise that ends it is
  /// another where the bench's scatter is known from few readings.
  double chi2 = 0;
};

/// How wide the 95 % interval of a parameter would be, as a part of its present width.
struct Narrowing {
  std::optional<double>
      hour;             ///< after an hour of one core more; none: not known how long runs take
  double exact = 1;     ///< were the simulation's means known exactly
  double readings = 1;  ///< with four times the bench readings
};

struct FittedParameter {
  std::string name;
  double value = 0;
  Interval interval;  ///< 95 %, profile likelihood
  Verdict verdict = Verdict::undetermined;
  std::string advice;  ///< what would determine it; empty for a determined one
  std::vector<ProfilePoint> profile;
  std::optional<Narrowing> narrowing = {};
};

/// An observable, measured and as the fitted parameters give it. In its unit.
struct FittedObservable {
  std::string name;
  std::string unit;
  double measured = 0;
  double measured_sd = 0;             ///< of single readings
  bool sd_assumed = false;            ///< the sd was not measured
  double measured_uncertainty = 0;    ///< standard uncertainty of the mean
  double systematic_uncertainty = 0;  ///< the part of it that all readings have in common
  double model_uncertainty = 0;       ///< standard uncertainty by what the model gets wrong
  double simulated = 0;               ///< expected, by the surrogate
  double simulated_uncertainty = 0;
  double simulated_sd = 0;      ///< scatter from seed to seed
  double predicted_sd = 0;      ///< scatter that it expects of single bench readings
  double difference_sigma = 0;  ///< (simulated - measured) / sigma of the fit
  Interval reachable;  ///< of the simulated mean within the bounds, as far as a bench can read it
};

/// A set of parameters that the data cannot tell from the best one; to be checked by simulation.
struct ParameterSet {
  std::vector<double> values;  ///< as in Problem::parameters
  double chi2 = 0;             ///< above that of the best fit
};

/// A set that was asked about, as the surrogates see it.
struct PredictedSet : ParameterSet {
  std::vector<double> simulated;  ///< each observable there
};

/// An observable as the surrogate gives it along one parameter, the others at the best fit.
struct ResponseCurve {
  std::size_t observable = 0;  ///< place in Problem::observables
  std::size_t parameter = 0;   ///< and in Problem::parameters
  std::vector<double> values;  ///< of the parameter, from bound to bound
  std::vector<double> simulated;
  std::vector<double> uncertainty;  ///< standard uncertainty of that
  std::vector<double> scatter;      ///< sd from seed to seed
};

/// The same over two parameters.
struct ResponseSurface {
  std::size_t observable = 0;
  std::size_t x_parameter = 0;
  std::size_t y_parameter = 0;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::vector<double>> simulated;  ///< a row for each y
};

/// What coarse runs taught a surrogate.
struct CoarseQuality {
  double size = 1;         ///< of their grains, as a multiple of the study's
  int runs = 0;            ///< with a reading
  int failed_runs = 0;     ///< without one, which says nothing of full runs
  double shift = 0;        ///< of their reading from that of full ones, at the best set, unit
  double uncertainty = 0;  ///< standard, of that
  double scatter = 1;      ///< of single ones, as a multiple of that of full ones
};

/// How well a surrogate knows its experiment.
struct SurrogateQuality {
  std::string observable;
  int runs = 0;                       ///< with a reading, coarse ones too
  int failed_runs = 0;                ///< full ones without
  double warp = 0;                    ///< y enters as asinh(y / warp); 0: as it is
  std::vector<double> length_scales;  ///< fractions of the bounds' distance; long: little effect
  double leave_one_out_sigma = 0;     ///< rms of standardised leave-one-out errors; 1 is right
  double leave_one_out_error = 0;     ///< rms of leave-one-out errors, seed noise included, unit
  double inflation = 1;               ///< by which its uncertainty was enlarged
  std::optional<CoarseQuality> coarse = {};  ///< none: all runs are full

  int full_runs() const { return runs - (coarse ? coarse->runs : 0); }
  /// By how many degrees of freedom the scatter of full runs is known, about.
  int scatter_df() const { return std::max(full_runs() - 1, 1); }
};

/// What was known after a round.
struct RoundSummary {
  int round = 0;
  int jobs = 0;                ///< so far
  double seconds = 0;          ///< so far, estimated
  std::vector<double> values;  ///< middle of the plausible sets, per parameter
  std::vector<double> sd;      ///< their scatter
  /// 95 % of them, per parameter; none in a result, whose fit says more.
  std::vector<Interval> intervals = {};
};

/// An experiment that the advice names and the study does not have.
struct StudyAddition {
  std::string experiment;
  std::string lines;  ///< its section of the study file
};

/// Sets of JointFit::drawn.
inline constexpr std::size_t kDrawnSets = 8;

struct JointFit {
  std::vector<FittedParameter> parameters;       ///< in Problem's order
  std::vector<FittedObservable> observables;     ///< in Problem's order
  std::vector<std::vector<double>> correlation;  ///< of the parameters, near the best fit
  /// Of the observables, from run to run of one experiment (reading_correlation.h).
  std::vector<std::vector<double>> reading_correlation;
  std::vector<std::vector<double>> bench_correlation;  ///< of their measured means
  std::vector<ParameterSet> equivalence_family;        ///< the best fit not included
  std::vector<PredictedSet> asked;                     ///< in the order of the question
  /// Drawn from the plausible sets, as probable as the data leave them; for predictions.
  std::vector<std::vector<double>> drawn;
  std::vector<StudyAddition> additions;      ///< each once
  std::vector<SurrogateQuality> surrogates;  ///< in order of the observables
  std::vector<ResponseCurve> curves;
  std::vector<ResponseSurface> surfaces;
  std::vector<RoundSummary> rounds;  ///< of the runs that propose() asked for
  std::vector<std::string> warnings;
  double chi2 = 0;  ///< least sum of squared difference_sigma, of priors too, by Problem's model_sd
  Freedom freedom;
  /// By what Observable::model_sd had to be multiplied (model_error.h); none: all are 0.
  std::optional<double> model_error_scale = {};
};

/// Fits all parameters to all observables at once, from runs that are done.
///
/// Each observable gets a surrogate of its runs (see THEORY.md), the fit minimises the sum of
/// ((simulated - measured) / sigma)^2 within the bounds. All runs count, proposed by propose() or
/// not; their order does not matter. `asked`: sets of parameters to be looked at, too. Throws
/// base::InputError with every error of the problem, and when fewer than three runs of an
/// experiment have the reading.
JointFit fit_jointly(const Problem& problem, const std::vector<Run>& runs,
                     const std::vector<std::vector<double>>& asked = {});

struct Solution;

/// The same of a problem that was solved (solution.h) with these runs, which are in_order.
JointFit fit_of(const Problem& problem, const std::vector<Run>& runs, const Solution& solution,
                const std::vector<std::vector<double>>& asked);

}  // namespace repose::calibrate
