#pragma once

#include <array>
#include <vector>

#include "calibrate/statistics/regress/quadratic.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {

using Box = std::vector<std::array<double, 2>>;

/// Where in the box the surface is lowest; the first such point found.
Eigen::VectorXd lowest_in_box(const Quadratic& surface, const Box& box);

/// Natural levels, the surface and its interval at a coded point.
SurfacePoint point_at(const Regression& regression, const Eigen::VectorXd& coded);

}  // namespace repose::calibrate
