#include <cmath>

#include <Eigen/Eigenvalues>

#include "calibrate/statistics/regress/box.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// v'Bv is a linear function of the coefficients; this is its standard error.
double curvature_error(const Regression& regression, const VectorXd& direction) {
  VectorXd weights = VectorXd::Zero(static_cast<Index>(regression.coefficients.size()));
  for (Index k = 0; k < weights.size(); ++k) {
    const Term& term = regression.coefficients[static_cast<std::size_t>(k)].term;
    if (term.size() < 2) continue;
    weights[k] =
        direction[static_cast<Index>(term.front())] * direction[static_cast<Index>(term.back())];
  }
  const Eigen::Map<const MatrixXd> covariance(regression.covariance.data(), weights.size(),
                                              weights.size());
  return std::sqrt(std::max(0.0, weights.dot(covariance * weights)));
}

bool is_in_box(const Box& box, const VectorXd& point) {
  for (std::size_t i = 0; i < box.size(); ++i) {
    const double value = point[static_cast<Index>(i)];
    if (value < box[i][0] || value > box[i][1]) return false;
  }
  return true;
}

/// The same sign on every machine: the largest part is positive.
VectorXd with_fixed_sign(const VectorXd& direction) {
  Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? VectorXd(-direction) : direction;
}

}  // namespace

std::optional<CanonicalForm> canonical_form(const Regression& regression) {
  if (regression.model != SurfaceModel::quadratic) return std::nullopt;
  const Quadratic surface = surface_of(regression);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(surface.curvature);
  const VectorXd& curvatures = solver.eigenvalues();
  CanonicalForm form;
  for (Index i = 0; i < curvatures.size(); ++i) {
    const VectorXd direction = with_fixed_sign(solver.eigenvectors().col(i));
    form.axes.push_back(
        {.curvature = curvatures[i],
         .uncertainty = regression.student_t * curvature_error(regression, direction),
         .direction = {direction.begin(), direction.end()}});
  }
  const double least = curvatures[0], greatest = curvatures[curvatures.size() - 1];
  form.shape = least > 0      ? SurfaceShape::minimum
               : greatest < 0 ? SurfaceShape::maximum
                              : SurfaceShape::saddle;
  constexpr double kLevel = 1e-12;
  if (curvatures.cwiseAbs().minCoeff() > kLevel * curvatures.cwiseAbs().maxCoeff()) {
    const VectorXd in_axes =
        (solver.eigenvectors().transpose() * surface.gradient).cwiseQuotient(-2 * curvatures);
    const VectorXd point = solver.eigenvectors() * in_axes;
    form.stationary = point_at(regression, point);
    form.is_inside = is_in_box(regression.box, point);
  }
  form.region = stationary_region(regression);
  return form;
}

}  // namespace repose::calibrate
