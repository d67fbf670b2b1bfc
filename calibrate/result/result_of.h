#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/result/result.h"
#include "calibrate/statistics/regress/surface_report.h"

namespace repose::calibrate {

/// A polynomial in the coefficients that an observable depends on, through the runs of its
/// experiment: quadratic, or with fewer terms if there are too few runs. std::nullopt if even a
/// plane has too many terms, or if nothing varies.
std::optional<SurfaceReport> surface_of_runs(const Problem& problem, const Observable& observable,
                                             const std::vector<Run>& runs);

/// The result of a fit alone, from runs of any program: not checked in simulations, and without
/// warnings so far. Its equally good sets are the fit's.
JointResult fitted_result(const Problem& problem, const JointFit& fit,
                          const std::vector<Run>& runs);

}  // namespace repose::calibrate
