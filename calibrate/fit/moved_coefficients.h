#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/sensitivity_check.h"

namespace repose::calibrate {

/// What a coefficient would have to be with the other value of an assumed input: with the stiffer
/// grains of the checks, or with more spheres.
struct MovedCoefficient {
  std::string name;
  double value = 0;
  Interval interval;  ///< 95 %, profile likelihood
  Verdict verdict = Verdict::undetermined;
};

/// In the order of Problem::parameters; none where no check knows what that changes. The same runs
/// fitted to means without these changes, which are as uncertain as the checks say: THEORY.md,
/// "Assumed inputs". Proved by StifferCoefficients.* in tests/calibrate.
std::vector<MovedCoefficient> moved_coefficients(const Problem& problem,
                                                 const std::vector<SensitivityCheck>& checks,
                                                 const std::vector<Run>& runs);

}  // namespace repose::calibrate
