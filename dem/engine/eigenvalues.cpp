#include "dem/engine/eigenvalues.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace repose::dem {

double greatest_eigenvalue(const Matrices& matrices) {
  if (matrices.empty()) return 0;
  // No eigenvalue is above the norm: few others are needed after that of the greatest norm.
  const auto norm = [](const Matrix6& matrix) { return matrix.squaredNorm(); };
  const Matrix6& first = *std::ranges::max_element(matrices, {}, norm);
  double greatest = 0;
  const auto see = [&greatest](const Matrix6& matrix) {
    if (matrix.squaredNorm() <= greatest * greatest) return;
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(matrix, Eigen::EigenvaluesOnly);
    greatest = std::max(greatest, solver.eigenvalues()[5]);
  };
  see(first);
  for (const Matrix6& matrix : matrices) see(matrix);
  return greatest;
}

}  // namespace repose::dem
