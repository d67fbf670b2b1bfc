#pragma once

#include <vector>

namespace repose::calibrate {

/// How far a fit could follow the random errors of the measured means that it was fitted to.
///
/// Formulae and reasons: THEORY.md, "Freedom". Proved by Freedom.* in tests/calibrate.
struct Freedom {
  /// Observables less the degrees of freedom used up by the coefficients: N - tr(J C J^T).
  double degrees = 0;
  double of_chi2 = 0;  ///< of JointFit::chi2, where prior knowledge counts like readings
  /// How much the expected reading of one observable (row) moves with the measured mean of another,
  /// in their units. Empty: nothing was fitted.
  std::vector<std::vector<double>> followed = {};
  /// Covariance of the readings expected at the best fit, from the uncertainty of the surrogates
  /// and of the prior knowledge.
  std::vector<std::vector<double>> unsure = {};
};

}  // namespace repose::calibrate
