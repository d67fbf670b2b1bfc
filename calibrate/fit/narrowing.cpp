#include "calibrate/fit/narrowing.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace repose::calibrate {
namespace {

constexpr double kHour_s = 3600;

/// A measured mean where it is plausible, in the units of its surrogate.
struct Seen {
  Eigen::VectorXd expected;  ///< at each of the plausible sets
  double bench2 = 0;         ///< variance of the measured mean by the scatter of its readings
  double lasting2 = 0;       ///< and by what they have in common, and the model's
  double surrogate2 = 0;     ///< of what the surrogate expects
};

Seen seen(const Solution& solution, std::size_t observable) {
  const std::vector<Point>& points = solution.sets.points;
  const auto count = static_cast<double>(points.size());
  Seen seen{.expected = Eigen::VectorXd(static_cast<Eigen::Index>(points.size())),
            .lasting2 = solution.misfit.lasting_variance(observable)};
  seen.bench2 = 1 / solution.misfit.weight(observable) - seen.lasting2;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Expectation w = solution.misfit.surrogates()[observable].at(points[k], false);
    seen.expected[static_cast<Eigen::Index>(k)] = w.mean;
    seen.surrogate2 += w.variance / count;
  }
  return seen;
}

/// Columns less their means.
Eigen::MatrixXd centred(Eigen::MatrixXd columns) {
  columns.rowwise() -= columns.colwise().mean().eval();
  return columns;
}

Eigen::MatrixXd columns_of(const std::vector<Point>& points) {
  Eigen::MatrixXd columns(points.size(), points.front().size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t j = 0; j < points[k].size(); ++j) {
      columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = points[k][j];
    }
  }
  return centred(std::move(columns));
}

/// The parts of the parameters' standard deviations that are left when the variance of every
/// observable falls from what it is to bench2 * `bench` + lasting2 + surrogate2 * `surrogate`:
/// as if it were measured once more, with the variance that makes up the difference.
std::vector<double> left_over(const Eigen::MatrixXd& parameters, const std::vector<Seen>& all,
                              double bench, double surrogate) {
  std::vector<double> more;
  Eigen::MatrixXd readings(parameters.rows(), 0);
  for (const Seen& one : all) {
    const double now = one.bench2 + one.lasting2 + one.surrogate2;
    const double then = one.bench2 * bench + one.lasting2 + one.surrogate2 * surrogate;
    if (!(then > 0) || !(now > then)) continue;
    more.push_back(now * then / (now - then));
    readings.conservativeResize(Eigen::NoChange, readings.cols() + 1);
    readings.rightCols(1) = one.expected;
  }
  std::vector<double> left(static_cast<std::size_t>(parameters.cols()), 1);
  if (more.empty()) return left;
  readings = centred(std::move(readings));
  const auto count = static_cast<double>(parameters.rows());
  Eigen::MatrixXd variance = readings.transpose() * readings / count;
  for (std::size_t i = 0; i < more.size(); ++i) {
    variance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += more[i];
  }
  const Eigen::MatrixXd shared = parameters.transpose() * readings / count;
  const Eigen::MatrixXd explained = shared * variance.ldlt().solve(shared.transpose());
  for (std::size_t j = 0; j < left.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double own = parameters.col(at).squaredNorm() / count;
    if (own > 0) left[j] = std::sqrt(std::clamp(1 - explained(at, at) / own, 0., 1.));
  }
  return left;
}

}  // namespace

std::vector<Narrowing> narrowing_of(const Solution& solution, double spent_s) {
  std::vector<Seen> all;
  for (std::size_t i = 0; i < solution.misfit.surrogates().size(); ++i) {
    if (!solution.misfit.surrogates()[i].constant()) all.push_back(seen(solution, i));
  }
  const Eigen::MatrixXd parameters = columns_of(solution.sets.points);
  // The variance of a mean falls as the number of its runs grows.
  const auto hour = left_over(parameters, all, 1, spent_s / (spent_s + kHour_s));
  const auto exact = left_over(parameters, all, 1, 0);
  const auto readings = left_over(parameters, all, 1. / kMoreReadings, 1);
  std::vector<Narrowing> narrowing;
  for (std::size_t j = 0; j < hour.size(); ++j) {
    narrowing.push_back({.hour = hour[j], .exact = exact[j], .readings = readings[j]});
  }
  return narrowing;
}

std::vector<double> narrowing_by_readings(const Solution& solution, std::size_t observable) {
  return left_over(columns_of(solution.sets.points), {seen(solution, observable)},
                   1. / kMoreReadings, 1);
}

}  // namespace repose::calibrate
