#include <algorithm>

#include <Eigen/Cholesky>

#include "base/distributions.h"
#include "calibrate/statistics/regress/quadratic.h"
#include "calibrate/statistics/regress/surface.h"

namespace repose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Levels of each factor that are looked at, by the number of factors: as many as take a moment.
constexpr std::array<int, 4> kLevels = {1001, 201, 51, 21};

/// Tells of any point whether the surface may be level there.
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

  /// Of each term (columns) by each factor.
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
