#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/stiffness_check.h"

namespace repose::calibrate {

/// What a coefficient would have to be with the stiffer grains of the checks.
struct StifferCoefficient {
  std::string name;
  double value = 0;
  Interval interval;  ///< 95 %, profile likelihood
  Verdict verdict = Verdict::undetermined;
};

/// In the order of Problem::parameters; none where no check knows what stiffer grains change. The
/// same runs fitted to means less these changes, which are as uncertain as the checks say:
/// THEORY.md, "Stiffer grains". Proved by StifferCoefficients.* in tests/calibrate.
std::vector<StifferCoefficient> stiffer_coefficients(const Problem& problem,
                                                     const std::vector<StiffnessCheck>& checks,
                                                     const std::vector<Run>& runs);

}  // namespace repose::calibrate
