#include "calibrate/fit/covariance.h"

#include <cmath>

namespace repose::calibrate {
namespace {

constexpr double kRoot5 = 2.2360679774997896964;
constexpr double kLevel2 = 4;  // the mean of the data is no surprise within two of their sd's

/// `decay` is exp(-sqrt5 r).
double matern(double r, double decay) { return (1 + kRoot5 * r + 5. / 3 * r * r) * decay; }
double matern(double r) { return matern(r, std::exp(-kRoot5 * r)); }

/// -M'(r) / r, finite at 0.
double matern_slope(double r, double decay) { return 5. / 3 * (1 + kRoot5 * r) * decay; }
double matern_slope(double r) { return matern_slope(r, std::exp(-kRoot5 * r)); }

}  // namespace

Eigen::MatrixXd as_rows(const std::vector<Point>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  const auto columns = static_cast<Eigen::Index>(points.empty() ? 0 : points.front().size());
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Point& point = points[static_cast<std::size_t>(i)];
    matrix.row(i) = Eigen::Map<const Eigen::RowVectorXd>(point.data(), columns);
  }
  return matrix;
}

Covariance::Covariance(const Hyperparameters& hyper)
    : length_(Eigen::Map<const Eigen::RowVectorXd>(hyper.length.data(),
                                                   static_cast<Eigen::Index>(hyper.length.size()))),
      signal2_(hyper.signal * hyper.signal),
      trend2_(hyper.trend * hyper.trend),
      noise2_(hyper.noise * hyper.noise) {}

Eigen::MatrixXd Covariance::scaled(const Eigen::MatrixXd& x) const {
  return (x.array() - .5).rowwise() / length_.array();
}

Eigen::MatrixXd Covariance::of_runs(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd s = scaled(x);
  Eigen::MatrixXd k = trend2_ * (s * s.transpose());
  for (Eigen::Index j = 0; j < s.rows(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      k(i, j) += kLevel2 + signal2_ * matern((s.row(i) - s.row(j)).norm());
      k(j, i) = k(i, j);
    }
    k(j, j) += kLevel2 + signal2_ + noise2_;
  }
  return k;
}

void Covariance::with_runs(const Eigen::MatrixXd& scaled_runs,
                           const Eigen::Ref<const Eigen::RowVectorXd>& here, Eigen::VectorXd& k,
                           Eigen::MatrixXd* slopes) const {
  const Eigen::RowVectorXd s = (here.array() - .5) / length_.array();
  k.noalias() = trend2_ * (scaled_runs * s.transpose());
  const Eigen::VectorXd distance = (scaled_runs.rowwise() - s).rowwise().norm();
  for (Eigen::Index i = 0; i < k.size(); ++i) {
    k(i) += kLevel2 + signal2_ * matern(distance(i));
  }
  if (slopes == nullptr) return;
  for (Eigen::Index i = 0; i < k.size(); ++i) {
    slopes->row(i) = (trend2_ * scaled_runs.row(i) -
                      signal2_ * matern_slope(distance(i)) * (s - scaled_runs.row(i)))
                         .array() /
                     length_.array();
  }
}

double Covariance::own(const Eigen::Ref<const Eigen::RowVectorXd>& here) const {
  return kLevel2 + signal2_ + trend2_ * ((here.array() - .5) / length_.array()).square().sum();
}

Eigen::RowVectorXd Covariance::own_gradient(
    const Eigen::Ref<const Eigen::RowVectorXd>& here) const {
  return 2 * trend2_ * (here.array() - .5) / length_.array().square();
}

Eigen::VectorXd Covariance::weighted_gradient(const Eigen::MatrixXd& x,
                                              const Eigen::MatrixXd& weight) const {
  const Eigen::MatrixXd s = scaled(x);
  const Eigen::Index d = s.cols();
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(d + 3);
  Eigen::ArrayXd square(d);
  for (Eigen::Index j = 0; j < s.rows(); ++j) {
    for (Eigen::Index i = 0; i < s.rows(); ++i) {
      square = (s.row(i) - s.row(j)).array().square();
      const double r = std::sqrt(square.sum());
      const double decay = std::exp(-kRoot5 * r);
      gradient.head(d).array() += weight(i, j) * signal2_ * matern_slope(r, decay) * square;
      gradient(d) += 2 * weight(i, j) * signal2_ * matern(r, decay);
    }
  }
  const Eigen::MatrixXd weighted = weight * s;
  for (Eigen::Index c = 0; c < d; ++c) {
    const double sum = trend2_ * s.col(c).dot(weighted.col(c));
    gradient(c) -= 2 * sum;
    gradient(d + 1) += 2 * sum;
  }
  gradient(d + 2) = 2 * noise2_ * weight.trace();
  return gradient;
}

}  // namespace repose::calibrate
