#pragma once

#include <vector>

namespace repose::calibrate {

/// How far a fit could follow the chance in the measured means that it was made from.
///
/// Formulae and reasons: THEORY.md, "Freedom". Proved by Freedom.* in tests/calibrate.
struct Freedom {
  /// Observables less the coefficients that they were used up by: N - tr(J C J^T).
  double degrees = 0;
  double of_chi2 = 0;  ///< of JointFit::chi2, where what is known beforehand counts as readings do
  /// By how much the expected reading of one observable (row) moves with the measured mean of
  /// another, in their units. Empty: nothing was fitted.
  std::vector<std::vector<double>> followed = {};
  /// Covariance of the readings expected at the best fit by what the surrogates and what is known
  /// beforehand leave open.
  std::vector<std::vector<double>> unsure = {};
};

}  // namespace repose::calibrate
