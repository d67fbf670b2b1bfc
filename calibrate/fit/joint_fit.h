#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/freedom.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// determined: the interval ends inside both bounds and is narrow: its half-width is at most 25 %
/// of the value or what the study calls useful. bounded: it ends inside both bounds but is wider:
/// known to an interval, not to a value. one_sided: it reaches one of them. undetermined: it
/// reaches both, or covers nearly all of the range between them.
enum class Verdict { determined, bounded, one_sided, undetermined };

struct Interval {
  double low = 0;
  double high = 0;
};

/// The best fit with one parameter held at `value`.
struct ProfilePoint {
  double value = 0;
  /// Above that of the best fit, scaled so that 3.84 ends the interval: the actual limit is
  /// different if the bench's scatter is known from few readings.
  double chi2 = 0;
};

/// Width of a parameter's 95 % interval relative to its present width, if more were known.
struct Narrowing {
  std::optional<double> hour;  ///< after one more core-hour; std::nullopt: run times unknown
  double exact = 1;            ///< if the simulation's means were known exactly
  double readings = 1;         ///< with four times the bench readings
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

/// An observable, as measured and as simulated with the fitted parameters. In its unit.
struct FittedObservable {
  std::string name;
  std::string unit;
  double measured = 0;
  double measured_sd = 0;             ///< of single readings
  bool sd_assumed = false;            ///< the sd was not measured
  double measured_uncertainty = 0;    ///< standard uncertainty of the mean
  double systematic_uncertainty = 0;  ///< the part of it common to all readings
  double model_uncertainty = 0;       ///< standard uncertainty due to errors of the model
  double simulated = 0;               ///< expected, by the surrogate
  double simulated_uncertainty = 0;
  double simulated_sd = 0;      ///< scatter from seed to seed
  double predicted_sd = 0;      ///< scatter expected of single bench readings
  double difference_sigma = 0;  ///< (simulated - measured) / sigma of the fit
  Interval reachable;  ///< of the simulated mean within the bounds, as far as a bench can read it
};

/// A parameter set that the data cannot distinguish from the best one; to be checked by simulation.
struct ParameterSet {
  std::vector<double> values;  ///< as in Problem::parameters
  double chi2 = 0;             ///< above that of the best fit
};

/// A queried set, as the surrogates predict it.
struct PredictedSet : ParameterSet {
  std::vector<double> simulated;  ///< each observable at this set
};

/// An observable predicted by the surrogate along one parameter, the others at the best fit.
struct ResponseCurve {
  std::size_t observable = 0;  ///< index in Problem::observables
  std::size_t parameter = 0;   ///< index in Problem::parameters
  std::vector<double> values;  ///< of the parameter, from bound to bound
  std::vector<double> simulated;
  std::vector<double> uncertainty;  ///< standard uncertainty of that
  std::vector<double> scatter;      ///< sd from seed to seed
};

/// The same for two parameters.
struct ResponseSurface {
  std::size_t observable = 0;
  std::size_t x_parameter = 0;
  std::size_t y_parameter = 0;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<std::vector<double>> simulated;  ///< a row for each y
};

/// What a surrogate learned about coarse runs.
struct CoarseQuality {
  double size = 1;         ///< of their grains, as a multiple of the study's
  int runs = 0;            ///< with a reading
  int failed_runs = 0;     ///< without one, which says nothing about full runs
  double shift = 0;        ///< of their reading from that of full ones, at the best set, unit
  double uncertainty = 0;  ///< standard, of that
  double scatter = 1;      ///< of single ones, as a multiple of that of full ones
};

/// How well a surrogate represents its experiment.
struct SurrogateQuality {
  std::string observable;
  int runs = 0;                       ///< with a reading, including coarse ones
  int failed_runs = 0;                ///< full ones without a reading
  double warp = 0;                    ///< y enters as asinh(y / warp); 0: untransformed
  std::vector<double> length_scales;  ///< fractions of the bounds' distance; long: little effect
  double leave_one_out_sigma = 0;     ///< rms of standardised leave-one-out errors; 1 is right
  double leave_one_out_error = 0;     ///< rms of leave-one-out errors, seed noise included, unit
  double inflation = 1;               ///< factor by which its uncertainty was enlarged
  double full_size = 1;               ///< of the grains of full runs, as a multiple of the study's
  std::optional<CoarseQuality> coarse = {};  ///< std::nullopt: all runs are full

  int full_runs() const { return runs - (coarse ? coarse->runs : 0); }
  /// Approximate degrees of freedom of the scatter of full runs.
  int scatter_df() const { return std::max(full_runs() - 1, 1); }
};

/// What was known after a round.
struct RoundSummary {
  int round = 0;
  int jobs = 0;                ///< so far
  double seconds = 0;          ///< so far, estimated
  std::vector<double> values;  ///< centre of the plausible sets, per parameter
  std::vector<double> sd;      ///< their scatter
  /// 95 % of them, per parameter; empty in a result, whose fit says more.
  std::vector<Interval> intervals = {};
};

/// An experiment that the advice names and the study does not have.
struct StudyAddition {
  std::string experiment;
  std::string lines;  ///< its section of the study file
};

/// Number of sets in JointFit::drawn.
inline constexpr std::size_t kDrawnSets = 8;

struct JointFit {
  std::vector<FittedParameter> parameters;       ///< in Problem's order
  std::vector<FittedObservable> observables;     ///< in Problem's order
  std::vector<std::vector<double>> correlation;  ///< of the parameters, near the best fit
  /// Of the observables, from run to run of one experiment (reading_correlation.h).
  std::vector<std::vector<double>> reading_correlation;
  std::vector<std::vector<double>> bench_correlation;  ///< of their measured means
  std::vector<ParameterSet> equivalence_family;        ///< the best fit not included
  std::vector<PredictedSet> asked;                     ///< in the order of the query
  /// Samples of the plausible sets, distributed as the data allow; for predictions.
  std::vector<std::vector<double>> drawn;
  std::vector<StudyAddition> additions;      ///< each once
  std::vector<SurrogateQuality> surrogates;  ///< in order of the observables
  std::vector<ResponseCurve> curves;
  std::vector<ResponseSurface> surfaces;
  std::vector<RoundSummary> rounds;  ///< of the runs that propose() requested
  std::vector<std::string> warnings;
  double chi2 = 0;  ///< least sum of squared difference_sigma and of priors, with Problem's
                    ///< model_sd
  Freedom freedom;
  /// Multiple of Observable::model_sd that was needed (solution.cpp); std::nullopt: all are 0.
  std::optional<double> model_error_scale = {};
};

/// Fits all parameters to all observables at once, from runs that are done.
///
/// Each observable gets a surrogate of its runs (see THEORY.md); the fit minimises the sum of
/// ((simulated - measured) / sigma)^2 within the bounds. All runs count, proposed by propose() or
/// not; their order does not matter. `asked`: further parameter sets to evaluate. Throws
/// base::InputError with every error of the problem, and when fewer than three runs of an
/// experiment have the reading.
JointFit fit_jointly(const Problem& problem, const std::vector<Run>& runs,
                     const std::vector<std::vector<double>>& asked = {});

struct Solution;

/// The same for a problem that was solved (solution.h) with these runs, which are in_order.
JointFit fit_of(const Problem& problem, const std::vector<Run>& runs, const Solution& solution,
                const std::vector<std::vector<double>>& asked);

}  // namespace repose::calibrate
