#include "calibrate/fit/gaussian_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <ceres/ceres.h>

#include "calibrate/fit/covariance.h"
#include "calibrate/fit/fit_watch.h"

namespace repose::calibrate {

namespace {

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

struct SearchResult {
  Hyperparameters hyper;
  double log_posterior = 0;
};

struct LogNormal {
  double log_median = 0;
  double log_sd = 1;
};

/// Shift, drift and noise of coarse values: 95 % within .04 ... 2 of the data's sd for the first
/// two, and .38 ... 2.7 of the full ones' noise.
constexpr std::array<LogNormal, 3> kCoarsePriors = {
    {{.log_median = -1.2, .log_sd = 1}, {.log_median = -1.2, .log_sd = 1}, {0, .5}}};

/// Logarithms of lengths, signal, trend and noise, and, if there are coarse values, of their shift,
/// drift and noise.
Hyperparameters from_logs(const double* logs, Eigen::Index dimensions, bool has_coarse) {
  Hyperparameters hyper;
  for (Eigen::Index i = 0; i < dimensions; ++i) hyper.length.push_back(std::exp(logs[i]));
  hyper.signal = std::exp(logs[dimensions]);
  hyper.trend = std::exp(logs[dimensions + 1]);
  hyper.noise = std::exp(logs[dimensions + 2]);
  if (has_coarse) {
    hyper.coarse = {.shift = std::exp(logs[dimensions + 3]),
                    .drift = std::exp(logs[dimensions + 4]),
                    .noise = std::exp(logs[dimensions + 5])};
  }
  return hyper;
}

std::vector<double> to_logs(const Hyperparameters& hyper) {
  std::vector<double> logs;
  for (const double length : hyper.length) logs.push_back(std::log(length));
  for (const double other : {hyper.signal, hyper.trend, hyper.noise}) {
    logs.push_back(std::log(other));
  }
  if (!hyper.coarse) return logs;
  for (const double other : {hyper.coarse->shift, hyper.coarse->drift, hyper.coarse->noise}) {
    logs.push_back(std::log(other));
  }
  return logs;
}

Eigen::ArrayXd as_array(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Minus the logarithm of the posterior density, and its gradient.
class MinusLogPosterior : public ceres::FirstOrderFunction {
 public:
  /// @param means  in the unit of `y`
  /// @param coarse  as for Covariance
  MinusLogPosterior(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, bool is_stochastic,
                    const MeansOfRuns& means, const Eigen::ArrayXd& coarse)
      : x_(x),
        y_(y),
        counts_(as_array(means.counts)),
        own_variances_(as_array(means.own_variances)),
        coarse_(coarse),
        squares_(means.squares),
        df_(means.df),
        priors_(static_cast<std::size_t>(x.cols()) + 2) {
    noise_ = priors_.size();
    priors_.push_back(is_stochastic ? LogNormal{std::log(.1), 1.5} : LogNormal{std::log(.001), 1});
    if (coarse.size() == 0) return;
    for (const LogNormal& prior : kCoarsePriors) priors_.push_back(prior);
  }

  int NumParameters() const override { return static_cast<int>(priors_.size()); }

  bool Evaluate(const double* logs, double* cost, double* gradient) const override {
    const Hyperparameters hyper = from_logs(logs, x_.cols(), coarse_.size() > 0);
    const Covariance covariance(hyper, counts_, own_variances_, coarse_);
    const Eigen::LLT<Eigen::MatrixXd> root(covariance.of_runs(x_));
    if (root.info() != Eigen::Success) return false;
    const Eigen::VectorXd alpha = root.solve(y_);
    *cost = .5 * y_.dot(alpha) + root.matrixLLT().diagonal().array().log().sum() +
            .5 * static_cast<double>(y_.size()) * std::log(2 * std::numbers::pi);
    if (gradient != nullptr) {
      Eigen::MatrixXd weight = root.solve(Eigen::MatrixXd::Identity(x_.rows(), x_.rows()));
      weight -= alpha * alpha.transpose();
      Eigen::Map<Eigen::VectorXd>(gradient, NumParameters()) =
          .5 * covariance.weighted_gradient(x_, weight);
    }
    if (df_ > 0) {
      // Runs about their means: squares ~ noise^2 chi-square(df).
      const double ratio = squares_ / (hyper.noise * hyper.noise);
      *cost += df_ * std::log(hyper.noise) + .5 * ratio;
      if (gradient != nullptr) gradient[noise_] += df_ - ratio;
    }
    for (std::size_t i = 0; i < priors_.size(); ++i) {
      const double off = (logs[i] - priors_[i].log_median) / priors_[i].log_sd;
      *cost += .5 * off * off;
      if (gradient != nullptr) gradient[i] += off / priors_[i].log_sd;
    }
    return std::isfinite(*cost);
  }

 private:
  const Eigen::MatrixXd& x_;
  const Eigen::VectorXd& y_;
  Eigen::ArrayXd counts_;
  Eigen::ArrayXd own_variances_;
  Eigen::ArrayXd coarse_;
  double squares_;
  double df_;
  std::vector<LogNormal> priors_;
  std::size_t noise_ = 0;  ///< its index among the logarithms
};

std::vector<Hyperparameters> own_starts(Eigen::Index dimensions, bool is_stochastic, int count) {
  constexpr std::array<double, 3> kLengths = {1, .3, 3};
  std::vector<Hyperparameters> starts;
  for (std::size_t i = 0; i < kLengths.size() && i < static_cast<std::size_t>(count); ++i) {
    starts.push_back({std::vector<double>(static_cast<std::size_t>(dimensions), kLengths[i]), 1, 1,
                      is_stochastic ? .2 : .001});
  }
  return starts;
}

/// The most probable hyperparameters of standardised values `y` at the rows of `x`.
///
/// Marginal likelihood (Rasmussen and Williams 2006, eq. 2.30, gradient 5.9) times log-normal
/// priors, with median 1 and 95 % between .14 and 7 for lengths, signal and trend; the noise has
/// median .1 (.005 ... 2), if deterministic .001 (.0001 ... .007); kCoarsePriors. Minimised by
/// L-BFGS from fixed starts.
SearchResult search_hyperparameters(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                    bool is_stochastic, const std::optional<Hyperparameters>& start,
                                    int starts, const MeansOfRuns& means,
                                    const Eigen::ArrayXd& coarse) {
  const bool has_coarse = coarse.size() > 0;
  std::vector<Hyperparameters> begins = own_starts(x.cols(), is_stochastic, starts);
  if (start) begins.push_back(*start);
  for (Hyperparameters& begin : begins) {
    if (!has_coarse) begin.coarse.reset();
    if (has_coarse && !begin.coarse) begin.coarse.emplace();
  }
  ceres::GradientProblem problem(new MinusLogPosterior(x, y, is_stochastic, means, coarse));
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-5;
  SearchCallback callback;
  options.callbacks.push_back(&callback);
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> best = to_logs(begins.front());
  for (const Hyperparameters& begin : begins) {
    std::vector<double> logs = to_logs(begin);
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(options, problem, logs.data(), &summary);
    stop_if_interrupted();
    if (summary.IsSolutionUsable() && summary.final_cost < least) {
      least = summary.final_cost;
      best = logs;
    }
  }
  return {from_logs(best.data(), x.cols(), has_coarse), -least};
}

}  // namespace

namespace {

/// As Covariance expects it; empty if all are full.
Eigen::ArrayXd coarse_of(const std::vector<RunKind>& kinds) {
  if (std::ranges::find(kinds, RunKind::coarse) == kinds.end()) return {};
  Eigen::ArrayXd coarse(static_cast<Eigen::Index>(kinds.size()));
  std::ranges::transform(kinds, coarse.begin(),
                         [](RunKind kind) { return kind == RunKind::coarse ? 1. : 0.; });
  return coarse;
}

}  // namespace

struct GaussianProcess::State {
  Eigen::MatrixXd x;       ///< a row per run
  Eigen::MatrixXd scaled;  ///< Covariance::scaled
  double middle = 0;
  double scale = 1;
  Hyperparameters hyper;
  double log_posterior = 0;
  Eigen::LLT<Eigen::MatrixXd> root;  ///< of K: preserves small variances that K^-1 would lose
  Eigen::VectorXd alpha;             ///< K^-1 y

  Covariance covariance{hyper};
};

GaussianProcess::GaussianProcess(const std::vector<Point>& x, const std::vector<double>& y,
                                 bool is_stochastic, const std::optional<Hyperparameters>& start,
                                 int starts, const MeansOfRuns& means,
                                 const std::vector<RunKind>& kinds) {
  auto state = std::make_shared<State>();
  state->x = as_rows(x);
  Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  state->middle = values.mean();
  values.array() -= state->middle;
  const double scale = std::sqrt(values.squaredNorm() / static_cast<double>(y.size()));
  state->scale = scale > 0 ? scale : 1;
  values /= state->scale;

  MeansOfRuns scaled = means;
  scaled.squares /= state->scale * state->scale;
  for (double& variance : scaled.own_variances) variance /= state->scale * state->scale;
  const Eigen::ArrayXd coarse = coarse_of(kinds);
  const SearchResult found =
      search_hyperparameters(state->x, values, is_stochastic, start, starts, scaled, coarse);
  state->hyper = found.hyper;
  state->covariance =
      Covariance(found.hyper, as_array(scaled.counts), as_array(scaled.own_variances), coarse);
  // The density of y, not of the scaled y.
  state->log_posterior =
      found.log_posterior - (static_cast<double>(y.size()) + means.df) * std::log(state->scale);
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

Expectation GaussianProcess::coarse_shift(const Point& x) const {
  const State& s = *state_;
  const Eigen::Map<const Eigen::RowVectorXd> here(x.data(), s.x.cols());
  Eigen::VectorXd k = s.covariance.shifts_with_runs(s.scaled, here);
  Expectation shift;
  shift.mean = s.scale * k.dot(s.alpha);
  s.root.matrixL().solveInPlace(k);
  shift.variance = s.scale * s.scale * std::max(0., s.covariance.own_shift() - k.squaredNorm());
  return shift;
}

std::vector<double> GaussianProcess::covariance(const std::vector<Point>& points,
                                                const std::vector<RunKind>& kinds) const {
  const State& s = *state_;
  const Covariance& covariance = s.covariance;
  const Eigen::ArrayXd coarse = coarse_of(kinds);
  const Covariance of_places = covariance.of_places(coarse);
  const Eigen::MatrixXd places = as_rows(points);
  const Eigen::MatrixXd scaled_places = covariance.scaled(places);
  Eigen::MatrixXd across(s.x.rows(), places.rows());
  Eigen::MatrixXd between(places.rows(), places.rows());
  for (Eigen::Index j = 0; j < places.rows(); ++j) {
    Eigen::VectorXd column(s.x.rows());
    covariance.with_runs(s.scaled, places.row(j), column, nullptr);
    Eigen::VectorXd own(places.rows());
    covariance.with_runs(scaled_places, places.row(j), own, nullptr);
    if (coarse.size() > 0 && coarse(j) > 0) {
      column += covariance.shifts_with_runs(s.scaled, places.row(j));
      own += of_places.shifts_with_runs(scaled_places, places.row(j));
    }
    across.col(j) = column;
    between.col(j) = own;
  }
  s.root.matrixL().solveInPlace(across);
  between -= across.transpose() * across;
  between *= s.scale * s.scale;
  return {between.data(), between.data() + between.size()};
}

double GaussianProcess::noise_sd(RunKind kind) const {
  const Hyperparameters& hyper = state_->hyper;
  const bool is_coarse = kind == RunKind::coarse && hyper.coarse;
  return state_->scale * hyper.noise * (is_coarse ? hyper.coarse->noise : 1);
}

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
