#include "calibrate/fit/gaussian_process.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/fit/covariance.h"
#include "calibrate/fit/hyperparameter_search.h"

namespace repose::calibrate {

struct GaussianProcess::State {
  Eigen::MatrixXd x;       ///< a row per run
  Eigen::MatrixXd scaled;  ///< Covariance::scaled
  double middle = 0;
  double scale = 1;
  Hyperparameters hyper;
  double log_posterior = 0;
  Eigen::LLT<Eigen::MatrixXd> root;  ///< of K: small variances survive in it, not in K^-1
  Eigen::VectorXd alpha;             ///< K^-1 y

  Covariance covariance{hyper};
};

GaussianProcess::GaussianProcess(const std::vector<Point>& x, const std::vector<double>& y,
                                 bool is_stochastic, const std::optional<Hyperparameters>& start,
                                 int starts) {
  auto state = std::make_shared<State>();
  state->x = as_rows(x);
  Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  state->middle = values.mean();
  values.array() -= state->middle;
  const double scale = std::sqrt(values.squaredNorm() / static_cast<double>(y.size()));
  state->scale = scale > 0 ? scale : 1;
  values /= state->scale;

  const SearchResult found = search_hyperparameters(state->x, values, is_stochastic, start, starts);
  state->hyper = found.hyper;
  state->covariance = Covariance(found.hyper);
  // The density of y, not of the scaled y.
  state->log_posterior =
      found.log_posterior - static_cast<double>(y.size()) * std::log(state->scale);
  state->scaled = state->covariance.scaled(state->x);
  state->root.compute(state->covariance.of_runs(state->x));
  state->alpha = state->root.solve(values);
  state_ = std::move(state);
}

Expectation GaussianProcess::at(const Point& x, bool with_gradients) const {
  const State& s = *state_;
  const Covariance& covariance = s.covariance;
  const Eigen::Index d = s.x.cols();
  const Eigen::Map<const Eigen::RowVectorXd> here(x.data(), d);
  Eigen::VectorXd k(s.x.rows());
  Eigen::MatrixXd slopes(with_gradients ? s.x.rows() : 0, d);
  covariance.with_runs(s.scaled, here, k, with_gradients ? &slopes : nullptr);
  const double scale2 = s.scale * s.scale;
  Expectation expectation;
  expectation.mean = s.middle + s.scale * k.dot(s.alpha);
  s.root.matrixL().solveInPlace(k);
  const Eigen::VectorXd& half = k;
  expectation.variance = scale2 * std::max(0.0, covariance.own(here) - half.squaredNorm());
  if (with_gradients) {
    const Eigen::VectorXd weights = s.root.matrixU().solve(half);
    const Eigen::VectorXd mean_gradient = s.scale * (slopes.transpose() * s.alpha);
    const Eigen::VectorXd variance_gradient =
        scale2 * (covariance.own_gradient(here).transpose() - 2 * slopes.transpose() * weights);
    expectation.mean_gradient.assign(mean_gradient.begin(), mean_gradient.end());
    expectation.variance_gradient.assign(variance_gradient.begin(), variance_gradient.end());
  }
  return expectation;
}

std::vector<double> GaussianProcess::covariance(const std::vector<Point>& points) const {
  const State& s = *state_;
  const Covariance& covariance = s.covariance;
  const Eigen::MatrixXd places = as_rows(points);
  const Eigen::MatrixXd scaled_places = covariance.scaled(places);
  Eigen::MatrixXd across(s.x.rows(), places.rows());
  Eigen::MatrixXd between(places.rows(), places.rows());
  for (Eigen::Index j = 0; j < places.rows(); ++j) {
    Eigen::VectorXd column(s.x.rows());
    covariance.with_runs(s.scaled, places.row(j), column, nullptr);
    across.col(j) = column;
    Eigen::VectorXd own(places.rows());
    covariance.with_runs(scaled_places, places.row(j), own, nullptr);
    between.col(j) = own;
  }
  s.root.matrixL().solveInPlace(across);
  between -= across.transpose() * across;
  between *= s.scale * s.scale;
  return {between.data(), between.data() + between.size()};
}

double GaussianProcess::noise_sd() const { return state_->scale * state_->hyper.noise; }

double GaussianProcess::log_posterior() const { return state_->log_posterior; }

const Hyperparameters& GaussianProcess::hyperparameters() const { return state_->hyper; }

std::vector<LeaveOneOut> GaussianProcess::leave_one_out() const {
  const Eigen::Index runs = state_->x.rows();
  const Eigen::MatrixXd inverse = state_->root.solve(Eigen::MatrixXd::Identity(runs, runs));
  std::vector<LeaveOneOut> all;
  for (Eigen::Index i = 0; i < runs; ++i) {
    const double precision = inverse(i, i);
    all.push_back(
        {state_->scale * state_->alpha(i) / precision, state_->scale / std::sqrt(precision)});
  }
  return all;
}

}  // namespace repose::calibrate
