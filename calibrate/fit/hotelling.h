#pragma once

#include <Eigen/Core>

// Internal to the comparison of several means at once: included by .cpp files only.
namespace repose::calibrate {

/// Covariance of the means of several readings, and by how many degrees of freedom it is known.
struct MeanCovariance {
  Eigen::MatrixXd matrix;
  double df = 0;
};

/// The probability that chance alone makes two vectors of means differ as much, neither scatter
/// being known: Hotelling's T^2 with the degrees of freedom of Krishnamoorthy and Yu (2004), Stat.
/// Probab. Lett. 66, 161, which are Welch's for a single reading.
double chance_of(const Eigen::VectorXd& difference, const MeanCovariance& one,
                 const MeanCovariance& other);

}  // namespace repose::calibrate
