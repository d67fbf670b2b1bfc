#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/sensitivity_check.h"

namespace repose::calibrate {

/// A measured mean whose scatter nobody measured, and the one that the fit took in its place.
struct AssumedScatter {
  std::string observable;
  double fraction = 0;  ///< standard deviation of single readings over |mean|
};

/// A coefficient, and what it would be if readings scattered otherwise than was assumed.
struct ScatterDependence {
  std::string name;
  std::vector<std::string> rests_on;  ///< observables whose assumed scatter moves it; or none
  MovedCoefficient half;              ///< with half the assumed standard deviations
  MovedCoefficient twice;             ///< with twice
};

/// What verdicts rest on where no scatter was measured.
struct AssumedScatters {
  std::vector<AssumedScatter> readings;         ///< none: all were measured
  std::vector<ScatterDependence> coefficients;  ///< in the order of Problem::parameters
};

/// The runs of `fit` fitted again with half and with twice every scatter that it assumed; half is
/// no less than what chance does in the simulation. What and why: THEORY.md, "An assumed scatter".
/// Proved by AssumedScatter.* in tests/calibrate.
AssumedScatters assumed_scatters(const Problem& problem, const std::vector<Run>& runs,
                                 const JointFit& fit);

}  // namespace repose::calibrate
