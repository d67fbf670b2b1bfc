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
  int readings = 1;        ///< behind the measured mean
  Point gradient;          ///< of the difference; empty unless derivatives are wanted
  Point variance_gradient;
  double model2 = 0;  ///< variance of what the model gets wrong, each reading by itself
};

/// How the errors of such differences vary together, of each pair; 1 on the diagonals.
struct PartCorrelation {
  std::vector<std::vector<double>> measured;  ///< of the measured means
  std::vector<std::vector<double>> expected;  ///< of what is expected
};

/// L^-1 r for the differences r and the covariance L L^T = V of their errors: independent, of
/// variance 1, and their squares sum up to r^T V^-1 r.
///
/// V_ij = rho_m,ij sqrt(m / M) s_i s_j + rho_e,ij sqrt(v_i v_j), and d_i^2 where i = j: m of the M
/// readings of a bench are taken to be of the same grains or heaps, m and M being the smaller and
/// the larger of both counts.
Residuals made_independent(const std::vector<CorrelatedPart>& parts,
                           const PartCorrelation& correlation, bool with_jacobian);

/// V of two of them.
double covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                     std::size_t one, std::size_t other);

/// How much two means have in common of which one has more readings.
double shared_readings(int one, int other);

/// The rows and columns of `all` that are named.
std::vector<std::vector<double>> part_of(const std::vector<std::vector<double>>& all,
                                         const std::vector<std::size_t>& names);

struct Risk {
  double fraction = 0;  ///< of failures among the runs nearby, 0 ... 1
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
  /// How much a run at one point tells of another: 1 at the same.
  double nearness(const Point& one, const Point& other) const;

 private:
  Attempts attempts_;
};

/// How badly a set of parameters fits, from everything that is known.
///
/// Formulae and reasons: THEORY.md, "Misfit". Proved by Misfit.* in tests/calibrate.
class Misfit {
 public:
  /// Learns surrogates of all observables from `runs` (in_order). `before`: of fewer runs, to start
  /// from. Throws base::InputError where an observable has too few readings.
  Misfit(const Problem& problem, const std::vector<Run>& runs, const std::optional<Misfit>& before,
         bool thorough);

  std::size_t dimensions() const { return parameters_.size(); }
  const std::vector<Surrogate>& surrogates() const { return surrogates_; }
  /// See Surrogate::inflate_near().
  void inflate_near(const Point& point);

  /// The same of other measured means, which are as uncertain.
  Misfit measuring(const std::vector<double>& means) const;

  /// Squared standardised differences, priors and risks of failure: what 3.84 is compared with.
  double chi2(const Point& point) const;
  /// (simulated - measured) / sigma of one observable.
  double difference(std::size_t observable, const Point& point) const;
  /// Squares of the surrogate's sd over the measured uncertainty: what more runs would tell.
  double surrogate_variance_fraction(std::size_t observable, const Point& point) const;
  /// Standard uncertainty of an observable's measured mean, in its unit. A scatter that was not
  /// measured is taken to be no less than what chance does to single readings in the simulation
  /// there (Experiment::readings_per_run): a bench has the same chance, and more.
  double measured_uncertainty(std::size_t observable) const { return measured_[observable]; }
  /// Of the observables, in what chance does to them together from run to run.
  const std::vector<std::vector<double>>& reading_correlation() const {
    return correlation_.expected;
  }
  /// And in what it does to the means of the bench: that of runs, as far as the simulation explains
  /// how they scatter.
  const std::vector<std::vector<double>>& bench_correlation() const {
    return correlation_.measured;
  }
  /// 1 over the variance of the measured mean and of the model's error, in the units of the
  /// observable's surrogate.
  double weight(std::size_t observable) const;
  /// The part of that variance which more readings do not lower.
  double lasting_variance(std::size_t observable) const {
    return targets_[observable].systematic2 + model_variance(observable);
  }
  /// Takes the model for so many times as wrong as Observable::model_sd says.
  void scale_model_errors(double scale) { model_scale_ = scale; }
  double model_scale() const { return model_scale_; }
  bool has_model_errors() const;
  /// What a search minimises: those of chi2(), and small ones that choose among equals.
  Residuals residuals(const Point& point, bool with_jacobian) const;
  /// Of the fit that has its minimum there (freedom.cpp).
  Freedom freedom(const Point& best) const;
  /// By how much chi2 may rise above its minimum, which is at `best`, within the 95 % interval of a
  /// coordinate: kChi2Limit where all scatters are known (interval_limit.cpp).
  double interval_limit(const Point& best, std::size_t coordinate) const;

 private:
  /// An observable in the units of its surrogate.
  struct Target {
    double value = 0;
    double sd = 0;
    double systematic2 = 0;  ///< of its square, what the readings have in common
    double model_sd = 0;     ///< Observable::model_sd
    double scatter2 = 0;     ///< of its square, what the scatter of the readings adds, not widened
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
  /// Their residuals, made independent of each other.
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

/// The slope of a residual that a robust loss has made of a difference, with that difference: below
/// 1, it counts less.
double robust_slope(double residual);

/// The share by which an uncertainty is widened because the sd is from few readings: Student's t of
/// n - 1 degrees of freedom over the normal's 1.96, at 95 %. 1 for an assumed sd.
double few_readings_factor(const Observable& observable);

}  // namespace repose::calibrate
