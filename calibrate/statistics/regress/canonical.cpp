#include "calibrate/statistics/regress/canonical.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "base/distributions.h"
#include "calibrate/statistics/regress/surface.h"

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
      // An interaction is split between B's two halves; a square gets both on the diagonal.
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

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Each variable is held at its lower or upper bound, or free.
enum class Hold { lower, upper, free };

/// The stationary point of one face in its free variables; std::nullopt if it is outside the box or
/// not unique. In the latter case the surface has the same value, or a lower one, on the rim.
std::optional<VectorXd> face_point(const Quadratic& surface, const Box& box,
                                   const std::vector<Hold>& holds) {
  VectorXd point = VectorXd::Zero(surface.gradient.size());
  std::vector<Index> free;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (holds[i] == Hold::free) {
      free.push_back(static_cast<Index>(i));
    } else {
      point[static_cast<Index>(i)] = box[i][holds[i] == Hold::upper ? 1 : 0];
    }
  }
  if (free.empty()) return point;
  const MatrixXd curvature = surface.curvature(free, free);
  const VectorXd slope = (surface.gradient + 2 * surface.curvature * point)(free);
  const Eigen::FullPivLU<MatrixXd> solver(curvature);
  if (!solver.isInvertible()) return std::nullopt;
  const VectorXd solution = solver.solve(-slope / 2);
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto& [low, high] = box[static_cast<std::size_t>(free[k])];
    const double value = solution[static_cast<Index>(k)];
    if (!(value >= low && value <= high)) return std::nullopt;
    point[free[k]] = value;
  }
  return point;
}

/// The next face, counting in base 3; false after the last.
bool advance(std::vector<Hold>& holds) {
  for (Hold& hold : holds) {
    if (hold == Hold::lower) {
      hold = Hold::upper;
      return true;
    }
    if (hold == Hold::upper) {
      hold = Hold::free;
      return true;
    }
    hold = Hold::lower;
  }
  return false;
}

}  // namespace

VectorXd lowest_in_box(const Quadratic& surface, const Box& box) {
  std::vector<Hold> holds(box.size(), Hold::lower);
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  do {
    const auto point = face_point(surface, box, holds);
    if (!point) continue;
    const double value = surface(*point);
    if (value < least) {
      least = value;
      best = *point;
    }
  } while (advance(holds));
  return best;
}

SurfacePoint point_at(const Regression& regression, const VectorXd& coded) {
  SurfacePoint point;
  point.coded = {coded.begin(), coded.end()};
  for (std::size_t i = 0; i < point.coded.size(); ++i) {
    point.natural.push_back(regression.factors[i].natural(point.coded[i]));
  }
  point.value = regression.predicted(point.coded);
  point.uncertainty = regression.student_t * regression.standard_error(point.coded);
  return point;
}

BoxExtremes extremes_in_box(const Regression& regression) {
  const Quadratic surface = surface_of(regression);
  return {point_at(regression, lowest_in_box(surface, regression.box)),
          point_at(regression, lowest_in_box(-surface, regression.box))};
}

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

/// A sign that is the same on every machine: the largest component is positive.
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

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Number of grid levels of each factor, by the number of factors: as many as take a moment.
constexpr std::array<int, 4> kLevels = {1001, 201, 51, 21};

/// Tests whether the surface may be stationary at a point.
class LevelTest {
 public:
  explicit LevelTest(const Regression& regression)
      : regression_(regression),
        surface_(surface_of(regression)),
        covariance_(regression.covariance.data(), count(), count()),
        limit_(limit_of(static_cast<double>(surface_.gradient.size()), regression.residual.df)) {}

  bool is_passed(const VectorXd& coded) const {
    const VectorXd slope = surface_.gradient + 2 * surface_.curvature * coded;
    const MatrixXd derivatives = derivatives_at(coded);
    const MatrixXd variance = derivatives * covariance_ * derivatives.transpose();
    return slope.dot(variance.ldlt().solve(slope)) <= limit_;
  }

 private:
  static double limit_of(double factors, double df) {
    constexpr double kChance = .05;
    return factors * base::fisher_f_exceeded(kChance, factors, df);
  }
  Index count() const { return static_cast<Index>(regression_.coefficients.size()); }

  /// Of each term (columns) with respect to each factor.
  MatrixXd derivatives_at(const VectorXd& coded) const {
    MatrixXd derivatives = MatrixXd::Zero(coded.size(), count());
    for (Index k = 0; k < count(); ++k) {
      const Term& term = regression_.coefficients[static_cast<std::size_t>(k)].term;
      for (std::size_t i = 0; i < term.size(); ++i) {
        const auto other = term.size() == 2 ? coded[static_cast<Index>(term[1 - i])] : 1;
        derivatives(static_cast<Index>(term[i]), k) += other;
      }
    }
    return derivatives;
  }

  const Regression& regression_;
  Quadratic surface_;
  Eigen::Map<const MatrixXd> covariance_;
  double limit_;
};

/// A grid over the box that the runs span.
class Grid {
 public:
  Grid(const Regression& regression, int levels)
      : box_(regression.box), levels_(levels), place_(box_.size(), 0) {}

  double level(std::size_t factor, int place) const {
    const auto& [low, high] = box_[factor];
    return low + (high - low) * place / (levels_ - 1);
  }
  VectorXd point() const {
    VectorXd coded(static_cast<Index>(box_.size()));
    for (std::size_t i = 0; i < box_.size(); ++i)
      coded[static_cast<Index>(i)] = level(i, place_[i]);
    return coded;
  }
  const std::vector<int>& place() const { return place_; }
  int last() const { return levels_ - 1; }

  /// False after the last point.
  bool next() {
    for (int& place : place_) {
      if (++place < levels_) return true;
      place = 0;
    }
    return false;
  }

 private:
  const std::vector<std::array<double, 2>>& box_;
  int levels_;
  std::vector<int> place_;
};

}  // namespace

std::optional<StationaryRegion> stationary_region(const Regression& regression) {
  const std::size_t factors = regression.factors.size();
  if (regression.model != SurfaceModel::quadratic || regression.is_exact ||
      factors > kLevels.size()) {
    return std::nullopt;
  }
  const LevelTest test(regression);
  Grid grid(regression, kLevels[factors - 1]);
  std::vector<std::array<int, 2>> ends(factors, {grid.last() + 1, -1});
  do {
    if (!test.is_passed(grid.point())) continue;
    for (std::size_t i = 0; i < factors; ++i) {
      ends[i] = {std::min(ends[i][0], grid.place()[i]), std::max(ends[i][1], grid.place()[i])};
    }
  } while (grid.next());
  StationaryRegion region{.is_in_box = ends.front()[1] >= 0, .ranges = {}};
  for (std::size_t i = 0; i < factors && region.is_in_box; ++i) {
    const auto natural = [&](int place, int outermost) {
      return place == outermost ? std::nullopt
                                : std::optional(regression.factors[i].natural(
                                      grid.level(i, place + (outermost > 0 ? 1 : -1))));
    };
    region.ranges.push_back({natural(ends[i][0], 0), natural(ends[i][1], grid.last())});
  }
  return region;
}

}  // namespace repose::calibrate
