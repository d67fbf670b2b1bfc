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

#include "calibrate/fit/fit_watch.h"

namespace repose::calibrate {

/// How values at two points of the unit box vary together, in variances of the data.
///
/// k(x, x') = signal^2 M(r) + trend^2 s.s' + level^2, with s = (x - 1/2) / length, r = |s - s'|,
/// M(r) = (1 + sqrt5 r + 5/3 r^2) exp(-sqrt5 r): Matern 5/2, Rasmussen and Williams (2006) eq.
/// 4.17, and their linear covariance, sec. 4.2.2 and 2.7. On the runs' diagonal is noise^2 besides,
/// by the number of runs that a value is the mean of, and a value's own variance, which is known.
class Covariance {
 public:
  /// @param counts  of runs that each value is the mean of; empty: of one
  /// @param own_variances  variance of each value beside the noise; empty: none has any
  explicit Covariance(const Hyperparameters& hyper, const Eigen::ArrayXd& counts = {},
                      const Eigen::ArrayXd& own_variances = {});

  /// Between all runs (rows of x), noise included.
  Eigen::MatrixXd of_runs(const Eigen::MatrixXd& x) const;
  /// (x - 1/2) / length, row by row.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& x) const;
  /// Between one place and all runs, whose rows are scaled() already; `slopes` (a row per run) with
  /// the place's coordinates.
  void with_runs(const Eigen::MatrixXd& scaled_runs,
                 const Eigen::Ref<const Eigen::RowVectorXd>& here, Eigen::VectorXd& k,
                 Eigen::MatrixXd* slopes) const;
  double own(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;
  Eigen::RowVectorXd own_gradient(const Eigen::Ref<const Eigen::RowVectorXd>& here) const;

  /// Sums of weight(i, j) dk(i, j) / d(log of a hyperparameter): lengths, signal, trend, noise.
  Eigen::VectorXd weighted_gradient(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weight) const;

 private:
  Eigen::RowVectorXd length_;
  double signal2_;
  double trend2_;
  double noise2_;
  Eigen::ArrayXd counts_;
  Eigen::ArrayXd own_variances_;
};

namespace {

constexpr double kRoot5 = 2.2360679774997896964;

constexpr double kLevel2 = 4;  // the mean of the data is no surprise within two of their sd's

/// `decay` is exp(-sqrt5 r).
double matern(double r, double decay) { return (1 + kRoot5 * r + 5. / 3 * r * r) * decay; }

double matern(double r) { return matern(r, std::exp(-kRoot5 * r)); }

/// -M'(r) / r, finite at 0.
double matern_slope(double r, double decay) { return 5. / 3 * (1 + kRoot5 * r) * decay; }

double matern_slope(double r) { return matern_slope(r, std::exp(-kRoot5 * r)); }

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

}  // namespace

Covariance::Covariance(const Hyperparameters& hyper, const Eigen::ArrayXd& counts,
                       const Eigen::ArrayXd& own_variances)
    : length_(Eigen::Map<const Eigen::RowVectorXd>(hyper.length.data(),
                                                   static_cast<Eigen::Index>(hyper.length.size()))),
      signal2_(hyper.signal * hyper.signal),
      trend2_(hyper.trend * hyper.trend),
      noise2_(hyper.noise * hyper.noise),
      counts_(counts),
      own_variances_(own_variances) {}

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
    k(j, j) += kLevel2 + signal2_ + (counts_.size() > 0 ? noise2_ / counts_(j) : noise2_);
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
  const double noise_weight =
      counts_.size() > 0 ? (weight.diagonal().array() / counts_).sum() : weight.trace();
  gradient(d + 2) = 2 * noise2_ * noise_weight;
  return gradient;
}

namespace {

struct SearchResult {
  Hyperparameters hyper;
  double log_posterior = 0;
};

struct LogNormal {
  double log_median = 0;
  double log_sd = 1;
};

/// Logarithms: lengths, signal, trend, noise.
Hyperparameters from_logs(const double* logs, Eigen::Index dimensions) {
  Hyperparameters hyper;
  for (Eigen::Index i = 0; i < dimensions; ++i) hyper.length.push_back(std::exp(logs[i]));
  hyper.signal = std::exp(logs[dimensions]);
  hyper.trend = std::exp(logs[dimensions + 1]);
  hyper.noise = std::exp(logs[dimensions + 2]);
  return hyper;
}

std::vector<double> to_logs(const Hyperparameters& hyper) {
  std::vector<double> logs;
  for (const double length : hyper.length) logs.push_back(std::log(length));
  for (const double other : {hyper.signal, hyper.trend, hyper.noise}) {
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
  MinusLogPosterior(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, bool is_stochastic,
                    const MeansOfRuns& means)
      : x_(x),
        y_(y),
        counts_(as_array(means.counts)),
        own_variances_(as_array(means.own_variances)),
        squares_(means.squares),
        df_(means.df),
        priors_(static_cast<std::size_t>(x.cols()) + 3) {
    priors_.back() = is_stochastic ? LogNormal{std::log(.1), 1.5} : LogNormal{std::log(.001), 1};
  }

  int NumParameters() const override { return static_cast<int>(priors_.size()); }

  bool Evaluate(const double* logs, double* cost, double* gradient) const override {
    const Hyperparameters hyper = from_logs(logs, x_.cols());
    const Covariance covariance(hyper, counts_, own_variances_);
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
      // Of the runs about their means: squares ~ noise^2 chi-square(df).
      const double ratio = squares_ / (hyper.noise * hyper.noise);
      *cost += df_ * std::log(hyper.noise) + .5 * ratio;
      if (gradient != nullptr) gradient[NumParameters() - 1] += df_ - ratio;
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
  double squares_;
  double df_;
  std::vector<LogNormal> priors_;
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
/// priors, of median 1 and 95 % between .14 and 7 for lengths, signal and trend; the noise has
/// median .1 (.005 ... 2), without chance .001 (.0001 ... .007). Minimised by L-BFGS from fixed
/// starts.
SearchResult search_hyperparameters(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                    bool is_stochastic, const std::optional<Hyperparameters>& start,
                                    int starts, const MeansOfRuns& means) {
  std::vector<Hyperparameters> begins = own_starts(x.cols(), is_stochastic, starts);
  if (start) begins.push_back(*start);
  ceres::GradientProblem problem(new MinusLogPosterior(x, y, is_stochastic, means));
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
  return {from_logs(best.data(), x.cols()), -least};
}

}  // namespace

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
                                 int starts, const MeansOfRuns& means) {
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
  const SearchResult found =
      search_hyperparameters(state->x, values, is_stochastic, start, starts, scaled);
  state->hyper = found.hyper;
  state->covariance =
      Covariance(found.hyper, as_array(scaled.counts), as_array(scaled.own_variances));
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
