#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/fit/plausible.h"
#include "calibrate/fit/problem.h"

/// What experiments would tell of the coefficients, before they are done.
namespace repose::calibrate {

/// An experiment that is done, or that could be.
struct ForecastTerm {
  std::string experiment;
  bool is_measured = false;
  int runs = 0;
  int failed_runs = 0;  ///< of these, without a reading
  /// Enough runs have a reading to say anything of it.
  bool is_known = false;
  /// Of each parameter: by how many of its uncertainties the mean reading changes from one bound to
  /// the other, the median over plausible materials. 0: it does not change.
  std::vector<double> effects;
};

/// What would be known of each parameter.
struct DesignForecast {
  /// Of the 95 % intervals, as a part of the distance of the bounds: medians over materials.
  std::vector<double> widths;
  /// Part of the plausible materials whose interval ends inside both bounds and leaves one value.
  std::vector<double> determined;
};

/// Readings taken of an experiment to be done, unless said otherwise.
inline constexpr int kUsualReadings = 10;

/// Expected intervals of parameters, for any set of experiments.
///
/// A material is a set of parameters that is plausible by what is measured so far. Around it, the
/// mean of n readings with error variance u^2 adds g g^T / (u^2 + s^2) to the precision of the
/// parameters, with the surrogate's gradient g and variance s^2, to that of the plausible sets'
/// covariance: Chaloner and Verdinelli (1995), Stat. Sci. 10, 273, sec. 4 (nonlinear models). Of
/// single readings u is taken as where no scatter was measured (Misfit::measured_uncertainty).
/// Unit box; valid where readings are nearly straight lines over the expected interval, as they are
/// where it is narrow. Proved by Foresight.* in tests/calibrate.
class Foresight {
 public:
  /// @param problem  with all experiments; observables are those of the ones that were measured
  /// @param runs  spread over the box, of every experiment
  /// @throws base::InputError  too few runs of a measured experiment have a reading.
  Foresight(const Problem& problem, const std::vector<Run>& runs, int readings);

  /// In the problem's order.
  const std::vector<ForecastTerm>& prospects() const { return prospects_; }
  /// With what is measured, and with some experiments more: places in prospects().
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
