#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/result/result.h"
#include "calibrate/statistics/regress/surface_report.h"

namespace repose::calibrate {

/// A polynomial of the coefficients that an observable depends on, through the runs of its
/// experiment: quadratic, or of as many terms as there are runs for. None where even a plane has
/// too many, or where nothing varies.
std::optional<SurfaceReport> surface_of_runs(const Problem& problem, const Observable& observable,
                                             const std::vector<Run>& runs);

/// What a fit alone found, from runs of whatever program: nothing was checked in simulations, and
/// no warning is in it yet. Its equally good sets are the fit's.
JointResult fitted_result(const Problem& problem, const JointFit& fit,
                          const std::vector<Run>& runs);

}  // namespace repose::calibrate
