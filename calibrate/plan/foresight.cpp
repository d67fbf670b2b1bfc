#include "calibrate/plan/foresight.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/distributions.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kEvery = 5;   // one plausible set in this many is a material
constexpr std::size_t kFewest = 8;  // required to learn a reading
// Of the runs nearby: if more fail, the experiment gives no reading for a material.
constexpr double kMaxFail = .5;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Eigen::MatrixXd covariance_of(const std::vector<Point>& points) {
  const auto dimensions = static_cast<Eigen::Index>(points.front().size());
  Eigen::MatrixXd all(dimensions, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(points[i].data(), dimensions);
  }
  all.colwise() -= all.rowwise().mean().eval();
  return all * all.transpose() / static_cast<double>(points.size());
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) {
  // Plausible sets may lie on a line: limits the precision of every parameter to a thousandth.
  constexpr double kRidge = 1e-6;
  const auto one = Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
  return (matrix + kRidge * one).ldlt().solve(Eigen::MatrixXd(one));
}

/// Standard uncertainty of the mean of that many readings where w is expected, in their unit.
double uncertainty_of_mean(const Surrogate& surrogate, double w, int readings,
                           const Experiment& experiment) {
  const double mean = std::abs(surrogate.warp().expected(w));
  const double by_scatter = std::max(experiment.usual_scatter * mean, surrogate.reading_sd(w)) /
                            std::sqrt(static_cast<double>(readings));
  const double shared = std::hypot(experiment.systematic_fraction * mean, experiment.systematic_sd);
  return std::hypot(by_scatter, shared, experiment.model_fraction * mean);
}

/// Change from one bound to the other, over the uncertainty of bench and surrogate.
double effect_of(const Surrogate& surrogate, const Point& material, std::size_t parameter,
                 double uncertainty) {
  Point low = material;
  Point high = material;
  low[parameter] = 0;
  high[parameter] = 1;
  const double change = surrogate.simulated(high) - surrogate.simulated(low);
  const double ends2 =
      (std::pow(surrogate.uncertainty(low), 2) + std::pow(surrogate.uncertainty(high), 2)) / 2;
  const double sigma = std::hypot(uncertainty, std::sqrt(ends2));
  return sigma > 0 ? std::abs(change) / sigma : 0;
}

}  // namespace

Foresight::Foresight(const Problem& problem, const std::vector<Run>& runs, int readings)
    : parameters_(problem.parameters) {
  const std::vector<Run> ordered = in_order(problem, runs);
  const Misfit misfit(problem, ordered, {}, true);
  const std::vector<Point> plausible = posterior_samples(misfit, problem.settings.seed).points;
  known_ = inverse(covariance_of(plausible));
  for (std::size_t i = 0; i < plausible.size(); i += kEvery) materials_.push_back(plausible[i]);
  for (const Experiment& experiment : problem.experiments) {
    learn(problem, ordered, experiment, readings);
  }
}

void Foresight::learn(const Problem& problem, const std::vector<Run>& runs,
                      const Experiment& experiment, int readings) {
  const auto dimensions = static_cast<Eigen::Index>(problem.parameters.size());
  const Attempts attempts = attempts_of(problem, experiment, runs);
  ForecastTerm& prospect = prospects_.emplace_back(ForecastTerm{
      .experiment = experiment.name,
      .is_measured =
          std::ranges::any_of(problem.observables,
                              [&](const Observable& o) { return o.experiment == experiment.name; }),
      .runs = static_cast<int>(attempts.places.size()),
      .failed_runs = attempts.failures(),
      .effects = std::vector<double>(problem.parameters.size(), 0)});
  auto& precisions =
      precisions_.emplace_back(materials_.size(), Eigen::MatrixXd::Zero(dimensions, dimensions));
  const TrainingSet training_set = training_set_of(problem, experiment, "value", runs);
  if (training_set.readings.size() < kFewest) return;
  prospect.is_known = true;
  const Surrogate surrogate(training_set, {}, true);
  if (surrogate.constant()) return;
  const FailureRisk risk(attempts);
  std::vector<std::vector<double>> effects(problem.parameters.size());
  for (std::size_t k = 0; k < materials_.size(); ++k) {
    const Expectation w = surrogate.at(materials_[k], true);
    const double u = uncertainty_of_mean(surrogate, w.mean, readings, experiment);
    const double u_w = u / surrogate.warp().slope(w.mean);
    const Eigen::Map<const Eigen::VectorXd> gradient(w.mean_gradient.data(), dimensions);
    if (!risk.any() || risk.at(materials_[k]).fraction < kMaxFail) {
      precisions[k] = gradient * gradient.transpose() / (u_w * u_w + w.variance);
    }
    for (const std::size_t parameter : experiment.parameters) {
      effects[parameter].push_back(effect_of(surrogate, materials_[k], parameter, u));
    }
  }
  for (const std::size_t parameter : experiment.parameters) {
    prospect.effects[parameter] = median(effects[parameter]);
  }
}

DesignForecast Foresight::with(const std::vector<std::size_t>& experiments) const {
  const std::size_t dimensions = materials_.front().size();
  std::vector<std::vector<double>> widths(dimensions);
  DesignForecast outlook{.widths = {}, .determined = std::vector<double>(dimensions, 0)};
  for (std::size_t k = 0; k < materials_.size(); ++k) {
    Eigen::MatrixXd precision = known_;
    for (const std::size_t experiment : experiments) {
      if (!prospects_[experiment].is_measured) precision += precisions_[experiment][k];
    }
    const Eigen::MatrixXd covariance = inverse(precision);
    for (std::size_t j = 0; j < dimensions; ++j) {
      const auto place = static_cast<Eigen::Index>(j);
      const double half = base::kNormal95 * std::sqrt(std::max(0., covariance(place, place)));
      const double low = std::max(0., materials_[k][j] - half);
      const double high = std::min(1., materials_[k][j] + half);
      widths[j].push_back(high - low);
      const Parameter& parameter = parameters_[j];
      const double box = parameter.max - parameter.min;
      const bool is_value = leaves_one_value(parameter, parameter.min + materials_[k][j] * box,
                                             (high - low) / 2 * box);
      if (low > 0 && high < 1 && is_value) {
        outlook.determined[j] += 1 / static_cast<double>(materials_.size());
      }
    }
  }
  for (const std::vector<double>& of_one : widths) outlook.widths.push_back(median(of_one));
  return outlook;
}

}  // namespace repose::calibrate
