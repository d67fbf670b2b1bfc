#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/fit/misfit.h"

namespace repose::calibrate {

inline Eigen::Index place_of(std::size_t place) { return static_cast<Eigen::Index>(place); }

/// A fit near its minimum: the sensitivity of the readings, in the units of their surrogates.
struct Misfit::Linearised {
  Eigen::MatrixXd slopes;       ///< of the expected readings (rows) along the coordinates, G
  Eigen::MatrixXd covariance;   ///< of the differences, V
  Eigen::MatrixXd not_widened;  ///< V without few_readings_factor()
  Eigen::MatrixXd unsure;       ///< of the expected readings alone
  Eigen::VectorXd unit;         ///< one of these, in the reading's own unit
};

/// How its coordinates follow the readings. Symbols: THEORY.md, "Freedom".
struct Misfit::NormalEquations {
  Eigen::MatrixXd whitening;            ///< L^-1
  Eigen::MatrixXd jacobian;             ///< J = L^-1 G
  Eigen::MatrixXd held;                 ///< B
  Eigen::LLT<Eigen::MatrixXd> inverse;  ///< C is its inverse
  Eigen::MatrixXd moved;                ///< C J^T
};

/// R^T R of the residuals' rows R, without the coordinates that are not free.
Eigen::MatrixXd squares_of(const std::vector<Point>& rows, std::size_t from, std::size_t to,
                           const std::vector<bool>& is_free);

/// A coordinate at its bound follows nothing.
std::vector<bool> free_coordinates(const Point& best);

}  // namespace repose::calibrate
