#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "calibrate/statistics/regress/regression.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {

/// Eigen uses signed indices.
inline Eigen::Index index_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// q(x) = a + g'x + x'Bx, B symmetric.
struct Quadratic {
  double constant = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;

  double operator()(const Eigen::VectorXd& x) const {
    return constant + gradient.dot(x) + x.dot(curvature * x);
  }
  Quadratic operator-() const { return {-constant, -gradient, -curvature}; }

  /// The same surface over fewer variables: the one at `index` is held at `value`.
  Quadratic with_fixed(Eigen::Index index, double value) const;
};

/// The fitted surface over the coded factors.
Quadratic surface_of(const Regression& regression);

/// The values of the terms at a point.
Eigen::VectorXd term_values(const std::vector<Coefficient>& coefficients,
                            std::span<const double> coded);

/// Fills in the coefficients of the factors in their own units.
void set_natural(Regression& regression);

using Box = std::vector<std::array<double, 2>>;

/// The point of the box at which the surface is lowest; the first such point found.
Eigen::VectorXd lowest_in_box(const Quadratic& surface, const Box& box);

/// Natural levels, the surface and its interval at a coded point.
SurfacePoint point_at(const Regression& regression, const Eigen::VectorXd& coded);

}  // namespace repose::calibrate
