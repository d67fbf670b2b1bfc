#pragma once

#include <optional>
#include <vector>

#include "calibrate/fit/misfit.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

struct Minimum {
  Point point;
  double chi2 = 0;       ///< Misfit::chi2 there
  double objective = 0;  ///< with the small residuals that choose among equals
};

/// Goes down from `start` within the box (Ceres, Levenberg and Marquardt with bounds); coordinate
/// `held` stays.
Minimum minimum_from(const Misfit& misfit, Point start, std::optional<std::size_t> held = {});

/// The least of the minima from `extra` starts and the best dozen of a spread of points.
Minimum least_minimum(const Misfit& misfit, const std::vector<Point>& extra);

}  // namespace repose::calibrate
