#include "calibrate/fit/covariance.h"

#include <cmath>

namespace repose::calibrate {

namespace {

constexpr double kRoot5 = 2.2360679774997896964;

constexpr double kLevel2 = 4;  // prior variance of the mean: an sd of two of the data's

/// `decay` is exp(-sqrt5 r).
double matern(double r, double decay) { return (1 + kRoot5 * r + 5. / 3 * r * r) * decay; }

double matern(double r) { return matern(r, std::exp(-kRoot5 * r)); }

/// -M'(r) / r, finite at 0.
double matern_slope(double r, double decay) { return 5. / 3 * (1 + kRoot5 * r) * decay; }

double matern_slope(double r) { return matern_slope(r, std::exp(-kRoot5 * r)); }

}  // namespace

Covariance::Covariance(const Hyperparameters& hyper, const Eigen::ArrayXd& counts,
                       const Eigen::ArrayXd& own_variances, const Eigen::ArrayXd& coarse)
    : length_(Eigen::Map<const Eigen::RowVectorXd>(hyper.length.data(),
                                                   static_cast<Eigen::Index>(hyper.length.size()))),
      signal2_(hyper.signal * hyper.signal),
      trend2_(hyper.trend * hyper.trend),
      noise2_(hyper.noise * hyper.noise),
      counts_(counts),
      own_variances_(own_variances),
      coarse_(coarse) {
  if (!hyper.coarse) return;
  shift2_ = hyper.coarse->shift * hyper.coarse->shift;
  drift2_ = hyper.coarse->drift * hyper.coarse->drift;
  coarse_noise2_ = noise2_ * hyper.coarse->noise * hyper.coarse->noise;
}

Covariance Covariance::of_places(const Eigen::ArrayXd& coarse) const {
  Covariance other = *this;
  other.coarse_ = coarse;
  return other;
}

Eigen::MatrixXd Covariance::scaled(const Eigen::MatrixXd& x) const {
  return (x.array() - .5).rowwise() / length_.array();
}

Eigen::MatrixXd Covariance::of_runs(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd s = scaled(x);
  Eigen::MatrixXd k = trend2_ * (s * s.transpose());
  for (Eigen::Index j = 0; j < s.rows(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      const double near = matern((s.row(i) - s.row(j)).norm());
      k(i, j) += kLevel2 + signal2_ * near;
      if (is_coarse(i) && is_coarse(j)) k(i, j) += shift2_ + drift2_ * near;
      k(j, i) = k(i, j);
    }
    k(j, j) += kLevel2 + signal2_ + noise2(j) + (is_coarse(j) ? own_shift() : 0);
    if (own_variances_.size() > 0) k(j, j) += own_variances_(j);
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

Eigen::VectorXd Covariance::shifts_with_runs(
    const Eigen::MatrixXd& scaled_runs, const Eigen::Ref<const Eigen::RowVectorXd>& here) const {
  Eigen::VectorXd shifts = Eigen::VectorXd::Zero(scaled_runs.rows());
  const Eigen::RowVectorXd s = (here.array() - .5) / length_.array();
  for (Eigen::Index i = 0; i < shifts.size(); ++i) {
    if (!is_coarse(i)) continue;
    shifts(i) = shift2_ + drift2_ * matern((scaled_runs.row(i) - s).norm());
  }
  return shifts;
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
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(d + (coarse_.size() > 0 ? 6 : 3));
  Eigen::ArrayXd square(d);
  for (Eigen::Index j = 0; j < s.rows(); ++j) {
    for (Eigen::Index i = 0; i < s.rows(); ++i) {
      square = (s.row(i) - s.row(j)).array().square();
      const double r = std::sqrt(square.sum());
      const double decay = std::exp(-kRoot5 * r);
      const double near = weight(i, j) * matern(r, decay);
      const bool are_coarse = is_coarse(i) && is_coarse(j);
      const double smooth2 = signal2_ + (are_coarse ? drift2_ : 0);
      gradient.head(d).array() += weight(i, j) * smooth2 * matern_slope(r, decay) * square;
      gradient(d) += 2 * signal2_ * near;
      if (!are_coarse) continue;
      gradient(d + 3) += 2 * shift2_ * weight(i, j);
      gradient(d + 4) += 2 * drift2_ * near;
    }
  }
  const Eigen::MatrixXd weighted = weight * s;
  for (Eigen::Index c = 0; c < d; ++c) {
    const double sum = trend2_ * s.col(c).dot(weighted.col(c));
    gradient(c) -= 2 * sum;
    gradient(d + 1) += 2 * sum;
  }
  for (Eigen::Index j = 0; j < s.rows(); ++j) {
    const double slope = 2 * noise2(j) * weight(j, j);
    gradient(d + 2) += slope;
    if (is_coarse(j)) gradient(d + 5) += slope;
  }
  return gradient;
}

}  // namespace repose::calibrate
