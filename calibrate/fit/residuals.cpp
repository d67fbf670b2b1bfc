#include "calibrate/fit/residuals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace repose::calibrate {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index index(std::size_t place) { return static_cast<Eigen::Index>(place); }

Matrix covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation) {
  Matrix covariance(index(parts.size()), index(parts.size()));
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      covariance(index(a), index(b)) = covariance_of(parts, correlation, a, b);
    }
  }
  return covariance;
}

/// Of the covariance, with one coordinate.
Matrix slope_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                std::size_t coordinate) {
  Matrix slope = Matrix::Zero(index(parts.size()), index(parts.size()));
  const auto sd_slope = [&](const CorrelatedPart& part) {
    return part.variance > 0 ? part.variance_gradient[coordinate] / (2 * std::sqrt(part.variance))
                             : 0;
  };
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      slope(index(a), index(b)) =
          correlation.expected[a][b] * (sd_slope(parts[a]) * std::sqrt(parts[b].variance) +
                                        std::sqrt(parts[a].variance) * sd_slope(parts[b]));
    }
  }
  return slope;
}

/// The lower triangle with half of the diagonal: dL = L half(L^-1 dV L^-T).
Matrix half(const Matrix& matrix) {
  Matrix lower = matrix.triangularView<Eigen::StrictlyLower>();
  lower.diagonal() = matrix.diagonal() / 2;
  return lower;
}

}  // namespace

double covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                     std::size_t one, std::size_t other) {
  const CorrelatedPart& a = parts[one];
  const CorrelatedPart& b = parts[other];
  return correlation.measured[one][other] * shared_readings(a.readings, b.readings) *
             a.measured_sd * b.measured_sd +
         correlation.expected[one][other] * std::sqrt(a.variance * b.variance) +
         (one == other ? a.model2 : 0);
}

double shared_readings(int one, int other) {
  return std::sqrt(static_cast<double>(std::min(one, other)) / std::max(one, other));
}

std::vector<std::vector<double>> part_of(const std::vector<std::vector<double>>& all,
                                         const std::vector<std::size_t>& names) {
  std::vector<std::vector<double>> part;
  for (const std::size_t row : names) {
    std::vector<double>& of_row = part.emplace_back();
    for (const std::size_t column : names) of_row.push_back(all[row][column]);
  }
  return part;
}

Residuals made_independent(const std::vector<CorrelatedPart>& parts,
                           const PartCorrelation& correlation, bool with_jacobian) {
  // What a search asks for most often, without a matrix.
  if (parts.size() == 1 && !with_jacobian) {
    const CorrelatedPart& alone = parts.front();
    return {{alone.difference / std::sqrt(covariance_of(parts, correlation, 0, 0))}, {}};
  }
  const Eigen::LLT<Matrix> root(covariance_of(parts, correlation));
  const auto lower = root.matrixL();
  Vector differences(index(parts.size()));
  for (std::size_t k = 0; k < parts.size(); ++k) differences(index(k)) = parts[k].difference;
  const Vector independent = lower.solve(differences);
  Residuals residuals;
  residuals.values.assign(independent.data(), independent.data() + independent.size());
  if (!with_jacobian) return residuals;
  const std::size_t coordinates = parts.front().gradient.size();
  residuals.jacobian.assign(parts.size(), Point(coordinates, 0));
  for (std::size_t j = 0; j < coordinates; ++j) {
    for (std::size_t k = 0; k < parts.size(); ++k) differences(index(k)) = parts[k].gradient[j];
    const Matrix left = lower.solve(slope_of(parts, correlation, j));
    const Matrix turned = lower.solve(left.transpose());
    const Vector slopes = lower.solve(differences) - half(turned) * independent;
    for (std::size_t k = 0; k < parts.size(); ++k) residuals.jacobian[k][j] = slopes(index(k));
  }
  return residuals;
}

}  // namespace repose::calibrate
