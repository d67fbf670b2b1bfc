#include "calibrate/fit/hyperparameter_search.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "calibrate/fit/covariance.h"
#include "calibrate/fit/search_callback.h"

namespace repose::calibrate {
namespace {

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

/// Minus the logarithm of the posterior density, and its gradient.
class MinusLogPosterior : public ceres::FirstOrderFunction {
 public:
  MinusLogPosterior(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, bool is_stochastic)
      : x_(x), y_(y), priors_(static_cast<std::size_t>(x.cols()) + 3) {
    priors_.back() = is_stochastic ? LogNormal{std::log(.1), 1.5} : LogNormal{std::log(.001), 1};
  }

  int NumParameters() const override { return static_cast<int>(priors_.size()); }

  bool Evaluate(const double* logs, double* cost, double* gradient) const override {
    const Covariance covariance(from_logs(logs, x_.cols()));
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

}  // namespace

SearchResult search_hyperparameters(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                    bool is_stochastic, const std::optional<Hyperparameters>& start,
                                    int starts) {
  std::vector<Hyperparameters> begins = own_starts(x.cols(), is_stochastic, starts);
  if (start) begins.push_back(*start);
  ceres::GradientProblem problem(new MinusLogPosterior(x, y, is_stochastic));
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

}  // namespace repose::calibrate
