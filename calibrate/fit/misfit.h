#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "calibrate/fit/freedom.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Residuals and their derivatives: jacobian[i][j] of residual i with coordinate j.
struct Residuals {
  std::vector<double> values;
  std::vector<Point> jacobian;
};

/// One of several differences whose errors vary together.
struct CorrelatedPart {
  double difference = 0;
  double measured_sd = 0;  ///< of the measured mean
  double variance = 0;     ///< of what is expected
  int readings = 1;        ///< number of readings behind the measured mean
  Point gradient;          ///< of the difference; empty unless derivatives are requested
  Point variance_gradient;
  double model2 = 0;  ///< variance of the model's error, independent for each reading
};

/// Correlations of the errors of such differences, for each pair; 1 on the diagonals.
struct PartCorrelation {
  std::vector<std::vector<double>> measured;  ///< of the measured means
  std::vector<std::vector<double>> expected;  ///< of the expected values
};

/// L^-1 r for the differences r and the covariance L L^T = V of their errors: independent, of
/// variance 1; their squares add up to r^T V^-1 r.
///
/// V_ij = rho_m,ij sqrt(m / M) s_i s_j + rho_e,ij sqrt(v_i v_j), plus d_i^2 if i = j: m of the M
/// readings of a bench are assumed to be of the same grains or heaps, m and M being the smaller and
/// the larger of both counts.
Residuals made_independent(const std::vector<CorrelatedPart>& parts,
                           const PartCorrelation& correlation, bool with_jacobian);

/// V of two of them.
double covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                     std::size_t one, std::size_t other);

/// Correlation of two means due to the readings they share, if one has more readings.
double shared_readings(int one, int other);

/// The rows and columns of `all` with these indices.
std::vector<std::vector<double>> part_of(const std::vector<std::vector<double>>& all,
                                         const std::vector<std::size_t>& names);

struct Risk {
  double fraction = 0;  ///< of failures among the nearby runs, 0 ... 1
  Point gradient;
};

/// How likely an experiment is to have no reading at a point: the fraction of failed runs around
/// it.
///
/// Weights fall off as a normal density of sd .1 sqrt(dimensions) of the box: Nadaraya (1964),
/// Theory Probab. Appl. 9, 141. A point far from all runs has no risk. Proved by FailureRisk.*.
class FailureRisk {
 public:
  explicit FailureRisk(Attempts attempts) : attempts_(std::move(attempts)) {}

  bool any() const { return attempts_.failures() > 0; }
  Risk at(const Point& point) const;
  /// Kernel weight of a run at one point for another point: 1 at the same point.
  double nearness(const Point& one, const Point& other) const;

 private:
  Attempts attempts_;
};

/// How badly a set of parameters fits, given everything that is known.
///
/// Formulae and reasons: THEORY.md, "Misfit". Proved by Misfit.* in tests/calibrate.
class Misfit {
 public:
  /// Learns surrogates of all observables from `runs` (in_order). `before`: a misfit of fewer runs,
  /// to start from. Throws base::InputError if an observable has too few readings.
  Misfit(const Problem& problem, const std::vector<Run>& runs, const std::optional<Misfit>& before,
         bool thorough);

  std::size_t dimensions() const { return parameters_.size(); }
  const std::vector<Surrogate>& surrogates() const { return surrogates_; }
  /// See Surrogate::inflate_near().
  void inflate_near(const Point& point);

  /// The same with other measured means of the same uncertainty.
  Misfit measuring(const std::vector<double>& means) const;

  /// Squared standardised differences, priors and risks of failure: the value compared with 3.84.
  double chi2(const Point& point) const;
  /// (simulated - measured) / sigma of one observable.
  double difference(std::size_t observable, const Point& point) const;
  /// Squared ratio of the surrogate's sd to the measured uncertainty: what more runs could reduce.
  double surrogate_variance_fraction(std::size_t observable, const Point& point) const;
  /// Standard uncertainty of an observable's measured mean, in its unit. A scatter that was not
  /// measured is assumed to be no less than that of single readings in the simulation there
  /// (Experiment::readings_per_run): a bench has the same random variation, and more.
  double measured_uncertainty(std::size_t observable) const { return measured_[observable]; }
  /// Correlations of the observables from run to run.
  const std::vector<std::vector<double>>& reading_correlation() const {
    return correlation_.expected;
  }
  /// Correlations of the bench's means: those of runs, as far as the simulation explains their
  /// scatter.
  const std::vector<std::vector<double>>& bench_correlation() const {
    return correlation_.measured;
  }
  /// Inverse of the variance of the measured mean and of the model's error, in the units of the
  /// observable's surrogate.
  double weight(std::size_t observable) const;
  /// The part of that variance that more readings do not reduce.
  double lasting_variance(std::size_t observable) const {
    return targets_[observable].systematic2 + model_variance(observable);
  }
  /// Scales the model's error to this multiple of Observable::model_sd.
  void scale_model_errors(double scale) { model_scale_ = scale; }
  double model_scale() const { return model_scale_; }
  bool has_model_errors() const;
  /// What a search minimises: those of chi2(), plus small ones that break ties.
  Residuals residuals(const Point& point, bool with_jacobian) const;
  /// Of the fit whose minimum is there (freedom.cpp).
  Freedom freedom(const Point& best) const;
  /// How far chi2 may rise above its minimum, which is at `best`, within the 95 % interval of a
  /// coordinate: kChi2Limit if all scatters are known (interval_limit.cpp).
  double interval_limit(const Point& best, std::size_t coordinate) const;

 private:
  /// An observable in the units of its surrogate.
  struct Target {
    double value = 0;
    double sd = 0;
    double systematic2 = 0;  ///< part of the variance common to all readings
    double model_sd = 0;     ///< Observable::model_sd
    double scatter2 = 0;     ///< part of the variance from the scatter of the readings, not widened
    double widening2 = 1;    ///< square of few_readings_factor(), by which it is widened
    double scatter_df = 0;   ///< degrees_of_scatter()
  };
  double model_variance(std::size_t observable) const;
  /// The observables of one experiment.
  struct Together {
    std::vector<std::size_t> observables;
    PartCorrelation correlation;
  };
  std::vector<CorrelatedPart> parts_of(const Together& together, const Point& point,
                                       bool with_jacobian) const;
  struct Linearised;
  Linearised linearised(const Point& best, const std::vector<bool>& is_free) const;
  struct NormalEquations;
  NormalEquations normal_equations(const Point& best, const std::vector<bool>& is_free,
                                   const Linearised& fit) const;
  /// Their residuals, decorrelated.
  void add_together(const Together& together, const Point& point, bool with_jacobian,
                    Residuals& all) const;
  void add_priors(const Point& point, bool with_jacobian, Residuals& all) const;

  std::vector<Parameter> parameters_;
  std::vector<Surrogate> surrogates_;
  std::vector<Target> targets_;
  std::vector<double> measured_;  ///< standard uncertainties
  std::vector<int> counts_;       ///< readings of the bench
  PartCorrelation correlation_;
  std::vector<Together> together_;
  std::vector<FailureRisk> risks_;
  double model_scale_ = 1;
  bool robust_ = false;
};

/// Derivative of a robust residual with respect to the difference it is made from: below 1, the
/// difference counts less.
double robust_slope(double residual);

/// The factor by which an uncertainty is widened because the sd is from few readings: Student's t
/// with n - 1 degrees of freedom over the normal's 1.96, at 95 %. 1 for an assumed sd.
double few_readings_factor(const Observable& observable);

}  // namespace repose::calibrate
