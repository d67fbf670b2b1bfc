#include "calibrate/statistics/regress/quadratic.h"

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

Quadratic Quadratic::with_fixed(Index index, double value) const {
  const Index n = gradient.size();
  std::vector<Index> saved;
  for (Index i = 0; i < n; ++i) {
    if (i != index) saved.push_back(i);
  }
  return {constant + gradient[index] * value + curvature(index, index) * value * value,
          gradient(saved) + 2 * value * curvature.col(index)(saved), curvature(saved, saved)};
}

Quadratic surface_of(const Regression& regression) {
  const Index n = index_of(regression.factors.size());
  Quadratic surface{0, VectorXd::Zero(n), MatrixXd::Zero(n, n)};
  for (const Coefficient& coefficient : regression.coefficients) {
    const Term& term = coefficient.term;
    if (term.empty()) {
      surface.constant = coefficient.value;
    } else if (term.size() == 1) {
      surface.gradient[index_of(term.front())] = coefficient.value;
    } else {
      // An interaction is spread over B's two halves; a square gets both on the diagonal.
      surface.curvature(index_of(term.front()), index_of(term.back())) += coefficient.value / 2;
      surface.curvature(index_of(term.back()), index_of(term.front())) += coefficient.value / 2;
    }
  }
  return surface;
}

VectorXd term_values(const std::vector<Coefficient>& coefficients, std::span<const double> coded) {
  VectorXd values = VectorXd::Ones(index_of(coefficients.size()));
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    for (const std::size_t factor : coefficients[k].term) values[index_of(k)] *= coded[factor];
  }
  return values;
}

void set_natural(Regression& regression) {
  // x = H^-1 (u - c), so B' = H^-1 B H^-1, g' = H^-1 g - 2 B'c, a' = a - c'H^-1 g + c'B'c.
  const Quadratic coded = surface_of(regression);
  const Index n = index_of(regression.factors.size());
  VectorXd centre(n), inverse(n);
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    centre[index_of(i)] = regression.factors[i].centre();
    inverse[index_of(i)] = 1 / regression.factors[i].half_range();
  }
  const MatrixXd curvature = inverse.asDiagonal() * coded.curvature * inverse.asDiagonal();
  const VectorXd scaled = inverse.cwiseProduct(coded.gradient);
  const VectorXd gradient = scaled - 2 * curvature * centre;
  for (Coefficient& coefficient : regression.coefficients) {
    const Term& term = coefficient.term;
    if (term.empty()) {
      coefficient.natural = coded.constant - centre.dot(scaled) + centre.dot(curvature * centre);
    } else if (term.size() == 1) {
      coefficient.natural = gradient[index_of(term.front())];
    } else {
      const double halves = term.front() == term.back() ? 1 : 2;
      coefficient.natural = halves * curvature(index_of(term.front()), index_of(term.back()));
    }
  }
}

}  // namespace repose::calibrate
