#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/fit/points.h"

namespace repose::calibrate {

/// Residuals and their derivatives: jacobian[i][j] of residual i with coordinate j.
struct Residuals {
  std::vector<double> values;
  std::vector<Point> jacobian;
};

/// One of several differences whose errors vary together.
struct CorrelatedPart {
  double difference = 0;
  double measured_sd = 0;  ///< of the measured mean
  double variance = 0;     ///< of what is expected
  int readings = 1;        ///< behind the measured mean
  Point gradient;          ///< of the difference; empty unless derivatives are wanted
  Point variance_gradient;
  double model2 = 0;  ///< variance of what the model gets wrong, each reading by itself
};

/// How the errors of such differences vary together, of each pair; 1 on the diagonals.
struct PartCorrelation {
  std::vector<std::vector<double>> measured;  ///< of the measured means
  std::vector<std::vector<double>> expected;  ///< of what is expected
};

/// L^-1 r for the differences r and the covariance L L^T = V of their errors: independent, of
/// variance 1, and their squares sum up to r^T V^-1 r.
///
/// V_ij = rho_m,ij sqrt(m / M) s_i s_j + rho_e,ij sqrt(v_i v_j), and d_i^2 where i = j: m of the M
/// readings of a bench are taken to be of the same grains or heaps, m and M being the smaller and
/// the larger of both counts.
Residuals made_independent(const std::vector<CorrelatedPart>& parts,
                           const PartCorrelation& correlation, bool with_jacobian);

/// V of two of them.
double covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                     std::size_t one, std::size_t other);

/// How much two means have in common of which one has more readings.
double shared_readings(int one, int other);

/// The rows and columns of `all` that are named.
std::vector<std::vector<double>> part_of(const std::vector<std::vector<double>>& all,
                                         const std::vector<std::size_t>& names);

}  // namespace repose::calibrate
