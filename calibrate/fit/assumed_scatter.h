#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/sensitivity_check.h"

namespace repose::calibrate {

/// A measured mean whose scatter was not measured, and the scatter that the fit assumed instead.
struct AssumedScatter {
  std::string observable;
  double fraction = 0;  ///< standard deviation of single readings over |mean|
};

/// A coefficient, and what it would be if the readings scattered differently than assumed.
struct ScatterDependence {
  std::string name;
  std::vector<std::string> rests_on;  ///< observables whose assumed scatter shifts it, if any
  MovedCoefficient half;              ///< with half the assumed standard deviations
  MovedCoefficient twice;             ///< with twice
};

/// What verdicts depend on where no scatter was measured.
struct AssumedScatters {
  std::vector<AssumedScatter> readings;         ///< empty: all were measured
  std::vector<ScatterDependence> coefficients;  ///< in the order of Problem::parameters
};

/// Refits the runs of `fit` with half and with twice every assumed scatter; half is never less than
/// the scatter by chance in the simulation. Reasons: THEORY.md, "An assumed scatter". Proved by
/// AssumedScatter.* in tests/calibrate.
AssumedScatters assumed_scatters(const Problem& problem, const std::vector<Run>& runs,
                                 const JointFit& fit);

}  // namespace repose::calibrate
