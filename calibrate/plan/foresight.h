#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/fit/plausible.h"
#include "calibrate/fit/problem.h"

/// What experiments would reveal about the coefficients, before they are done.
namespace repose::calibrate {

/// An experiment that was done, or could be.
struct ForecastTerm {
  std::string experiment;
  bool is_measured = false;
  int runs = 0;
  int failed_runs = 0;  ///< of these, without a reading
  /// Enough runs have a reading to say anything about it.
  bool is_known = false;
  /// For each parameter: change of the mean reading from one bound to the other, in units of its
  /// uncertainty, the median over plausible materials. 0: no change.
  std::vector<double> effects;
};

/// Expected knowledge of each parameter.
struct DesignForecast {
  /// Widths of the 95 % intervals, as fractions of the bounds' distance: medians over materials.
  std::vector<double> widths;
  /// Fraction of the plausible materials whose interval is inside both bounds and leaves one value.
  std::vector<double> determined;
};

/// Default number of readings of a future experiment.
inline constexpr int kUsualReadings = 10;

/// Expected intervals of parameters, for any set of experiments.
///
/// A material is a set of parameters that is plausible given the measurements so far. Around it,
/// the mean of n readings with error variance u^2 adds g g^T / (u^2 + s^2) to the precision of the
/// parameters, with the surrogate's gradient g and variance s^2, to that of the plausible sets'
/// covariance: Chaloner and Verdinelli (1995), Stat. Sci. 10, 273, sec. 4 (nonlinear models). For
/// single readings u is assumed as where no scatter was measured (Misfit::measured_uncertainty).
/// Unit box; valid if readings are nearly linear over the expected interval, as they are if it is
/// narrow. Proved by Foresight.* in tests/calibrate.
class Foresight {
 public:
  /// @param problem  with all experiments; observables are those of the measured ones
  /// @param runs  spread over the box, of every experiment
  /// @throws base::InputError  too few runs of a measured experiment have a reading.
  Foresight(const Problem& problem, const std::vector<Run>& runs, int readings);

  /// In the problem's order.
  const std::vector<ForecastTerm>& prospects() const { return prospects_; }
  /// With the present measurements and some additional experiments: indices in prospects().
  DesignForecast with(const std::vector<std::size_t>& experiments) const;

 private:
  void learn(const Problem& problem, const std::vector<Run>& runs, const Experiment& experiment,
             int readings);

  std::vector<Parameter> parameters_;
  std::vector<ForecastTerm> prospects_;
  std::vector<Point> materials_;
  Eigen::MatrixXd known_;                                 ///< precision of the plausible sets
  std::vector<std::vector<Eigen::MatrixXd>> precisions_;  ///< by prospect and material
};

}  // namespace repose::calibrate
