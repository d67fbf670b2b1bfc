#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

namespace repose::dem {

/// A body's three ways to move and three to turn.
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrices = std::vector<Matrix6, Eigen::aligned_allocator<Matrix6>>;

/// Of any of these matrices, symmetric and with no negative eigenvalue; 0 of none.
double greatest_eigenvalue(const Matrices& matrices);

}  // namespace repose::dem
