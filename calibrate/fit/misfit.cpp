#include "calibrate/fit/misfit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/core.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/reading_correlation.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index index(std::size_t place) { return static_cast<Eigen::Index>(place); }

Matrix covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation) {
  Matrix covariance(index(parts.size()), index(parts.size()));
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      covariance(index(a), index(b)) = covariance_of(parts, correlation, a, b);
    }
  }
  return covariance;
}

/// Derivative of the covariance with respect to one coordinate.
Matrix slope_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                std::size_t coordinate) {
  Matrix slope = Matrix::Zero(index(parts.size()), index(parts.size()));
  const auto sd_slope = [&](const CorrelatedPart& part) {
    return part.variance > 0 ? part.variance_gradient[coordinate] / (2 * std::sqrt(part.variance))
                             : 0;
  };
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      slope(index(a), index(b)) =
          correlation.expected[a][b] * (sd_slope(parts[a]) * std::sqrt(parts[b].variance) +
                                        std::sqrt(parts[a].variance) * sd_slope(parts[b]));
    }
  }
  return slope;
}

/// The lower triangle with half of the diagonal: dL = L half(L^-1 dV L^-T).
Matrix half(const Matrix& matrix) {
  Matrix lower = matrix.triangularView<Eigen::StrictlyLower>();
  lower.diagonal() = matrix.diagonal() / 2;
  return lower;
}

}  // namespace

double covariance_of(const std::vector<CorrelatedPart>& parts, const PartCorrelation& correlation,
                     std::size_t one, std::size_t other) {
  const CorrelatedPart& a = parts[one];
  const CorrelatedPart& b = parts[other];
  return correlation.measured[one][other] * shared_readings(a.readings, b.readings) *
             a.measured_sd * b.measured_sd +
         correlation.expected[one][other] * std::sqrt(a.variance * b.variance) +
         (one == other ? a.model2 : 0);
}

double shared_readings(int one, int other) {
  return std::sqrt(static_cast<double>(std::min(one, other)) / std::max(one, other));
}

std::vector<std::vector<double>> part_of(const std::vector<std::vector<double>>& all,
                                         const std::vector<std::size_t>& names) {
  std::vector<std::vector<double>> part;
  for (const std::size_t row : names) {
    std::vector<double>& of_row = part.emplace_back();
    for (const std::size_t column : names) of_row.push_back(all[row][column]);
  }
  return part;
}

Residuals made_independent(const std::vector<CorrelatedPart>& parts,
                           const PartCorrelation& correlation, bool with_jacobian) {
  // The most frequent case in a search, without a matrix.
  if (parts.size() == 1 && !with_jacobian) {
    const CorrelatedPart& alone = parts.front();
    return {{alone.difference / std::sqrt(covariance_of(parts, correlation, 0, 0))}, {}};
  }
  const Eigen::LLT<Matrix> root(covariance_of(parts, correlation));
  const auto lower = root.matrixL();
  Vector differences(index(parts.size()));
  for (std::size_t k = 0; k < parts.size(); ++k) differences(index(k)) = parts[k].difference;
  const Vector independent = lower.solve(differences);
  Residuals residuals;
  residuals.values.assign(independent.data(), independent.data() + independent.size());
  if (!with_jacobian) return residuals;
  const std::size_t coordinates = parts.front().gradient.size();
  residuals.jacobian.assign(parts.size(), Point(coordinates, 0));
  for (std::size_t j = 0; j < coordinates; ++j) {
    for (std::size_t k = 0; k < parts.size(); ++k) differences(index(k)) = parts[k].gradient[j];
    const Matrix left = lower.solve(slope_of(parts, correlation, j));
    const Matrix turned = lower.solve(left.transpose());
    const Vector slopes = lower.solve(differences) - half(turned) * independent;
    for (std::size_t k = 0; k < parts.size(); ++k) residuals.jacobian[k][j] = slopes(index(k));
  }
  return residuals;
}

namespace {

constexpr double kWidth = .1;           // of the box, times the root of its dimensions
constexpr double kUnknownWeight = .02;  // of a success assumed everywhere

}  // namespace

double FailureRisk::nearness(const Point& one, const Point& other) const {
  const std::vector<std::size_t>& seen = attempts_.parameters;
  double distance2 = 0;
  for (const std::size_t parameter : seen) {
    distance2 += std::pow(one[parameter] - other[parameter], 2);
  }
  return std::exp(-distance2 / (2 * kWidth * kWidth * static_cast<double>(seen.size())));
}

Risk FailureRisk::at(const Point& point) const {
  Risk risk;
  risk.gradient.assign(point.size(), 0);
  if (!any()) return risk;
  const std::vector<std::size_t>& seen = attempts_.parameters;
  const double width2 = kWidth * kWidth * static_cast<double>(seen.size());
  double all = kUnknownWeight;
  double failed = 0;
  Point all_gradient(point.size(), 0);
  Point failed_gradient(point.size(), 0);
  for (std::size_t run = 0; run < attempts_.places.size(); ++run) {
    double distance2 = 0;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double off = point[seen[c]] - attempts_.places[run][c];
      distance2 += off * off;
    }
    const double weight = std::exp(-distance2 / (2 * width2));
    all += weight;
    if (attempts_.failed[run]) failed += weight;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double slope = -weight * (point[seen[c]] - attempts_.places[run][c]) / width2;
      all_gradient[seen[c]] += slope;
      if (attempts_.failed[run]) failed_gradient[seen[c]] += slope;
    }
  }
  risk.fraction = failed / all;
  for (std::size_t i = 0; i < point.size(); ++i) {
    risk.gradient[i] = (failed_gradient[i] - risk.fraction * all_gradient[i]) / all;
  }
  return risk;
}

namespace {

constexpr double kRobust = 2;     // larger differences, in sigma, count less if requested
constexpr double kPull = .1;      // per box width: towards the middle, to break ties
constexpr double kDistrust = .1;  // towards where the surrogate is certain, to break ties
constexpr double kFailure = 4;    // makes a failure probability of one half alone exceed 3.84
constexpr std::size_t kFewestToLearn = 3;  // readings required

/// Cauchy's loss as a residual: its square is c^2 log(1 + z^2 / c^2). Also returns its slope.
std::pair<double, double> robust_residual(double z) {
  const double fraction = z * z / (kRobust * kRobust);
  const double value = std::copysign(kRobust * std::sqrt(std::log1p(fraction)), z);
  return {value, std::abs(value) > 1e-9 ? z / (value * (1 + fraction)) : 1};
}

/// `scatter_by_chance`: of single readings.
double uncertainty_of_mean(const Observable& observable, double scatter_by_chance) {
  const double known = standard_uncertainty(observable);
  if (observable.sd) return known;
  return std::max(known, scatter_by_chance / std::sqrt(static_cast<double>(observable.n)));
}

/// Fraction of the variance of the bench's single readings due to differences from run to run,
/// which readings of one run share. Views of one heap, and reading by eye, vary independently.
double explained_fraction(const Surrogate& surrogate, double w, double bench_variance) {
  const double run_sd = surrogate.warp().scatter(w);
  const double simulated = surrogate.training_set().readings_per_run * run_sd * run_sd;
  return std::min(1., simulated / bench_variance);
}

base::Fault too_few(const Observable& observable, std::size_t readings,
                    const std::vector<Run>& runs, bool has_coarse) {
  int attempts = 0;
  std::string failure;
  std::string names;
  for (const Run& run : runs) {
    if (run.job.experiment != observable.experiment) continue;
    ++attempts;
    if (failure.empty()) failure = run.failure;
    for (const auto& [name, value] : run.readings) {
      const std::string quoted = fmt::format(" \"{}\"", name);
      if (names.find(quoted) == std::string::npos) names += quoted;
    }
  }
  std::string text = fmt::format("{} of {} runs of {} have the reading \"{}\": too few.", readings,
                                 attempts, observable.experiment, observable.reading);
  if (!names.empty()) text += " Available readings:" + names + ".";
  if (!failure.empty()) text += " Some failed: " + failure + ".";
  return {.where = observable.name,
          .value = std::move(text),
          .fix = has_coarse ? "change the bounds, use another reading, or make no runs of larger "
                              "grains: --fidelity full"
                            : "change the bounds, or use another reading"};
}

}  // namespace

double robust_slope(double residual) {
  if (std::abs(residual) < 1e-9) return 1;
  const double fraction = std::expm1(residual * residual / (kRobust * kRobust));
  return robust_residual(kRobust * std::sqrt(fraction)).second;
}

double few_readings_factor(const Observable& observable) {
  const double df = degrees_of_scatter(observable);
  return std::isfinite(df) ? base::student_t_quantile(.975, df) / base::kNormal95 : 1;
}

Misfit::Misfit(const Problem& problem, const std::vector<Run>& runs,
               const std::optional<Misfit>& before, bool thorough)
    : parameters_(problem.parameters), robust_(problem.settings.robust) {
  base::Faults errors;
  std::vector<double> explained;  // fractions of the variances of measured means
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const Observable& observable = problem.observables[i];
    const TrainingSet training_set = training_set_of(
        problem, experiment_named(problem, observable.experiment), observable.reading, runs);
    if (training_set.readings.size() < kFewestToLearn) {
      const bool has_coarse = experiment_named(problem, observable.experiment).coarse.has_value();
      errors.add(too_few(observable, training_set.readings.size(), runs, has_coarse));
      continue;
    }
    std::optional<Surrogate> start;
    if (before) start = before->surrogates_[i];
    surrogates_.emplace_back(training_set, start, thorough);
    const AsinhWarp& warp = surrogates_.back().warp();
    const double w = warp.of_expected(observable.mean);
    const double by_scatter = uncertainty_of_mean(observable, surrogates_.back().reading_sd(w));
    measured_.push_back(with_systematic(observable, by_scatter));
    explained.push_back(
        explained_fraction(surrogates_.back(), w, observable.n * by_scatter * by_scatter) *
        std::pow(by_scatter / measured_.back(), 2));
    const double widening = few_readings_factor(observable);
    const double sd =
        std::hypot(with_systematic(observable, widening * by_scatter), observable.shift_sd);
    targets_.push_back({.value = w,
                        .sd = sd / warp.slope(w),
                        .systematic2 = std::pow(observable.systematic_sd / warp.slope(w), 2),
                        .model_sd = observable.model_sd / warp.slope(w),
                        .scatter2 = std::pow(by_scatter / warp.slope(w), 2),
                        .widening2 = widening * widening,
                        .scatter_df = degrees_of_scatter(observable)});
  }
  errors.throw_if_any();
  correlation_.expected = reading_correlation_of(problem, surrogates_);
  correlation_.measured = correlation_.expected;
  for (std::size_t i = 0; i < explained.size(); ++i) {
    for (std::size_t k = 0; k < explained.size(); ++k) {
      if (i != k) correlation_.measured[i][k] *= std::sqrt(explained[i] * explained[k]);
    }
  }
  for (const std::vector<std::size_t>& observables : by_experiment(problem)) {
    together_.push_back({observables,
                         {.measured = part_of(correlation_.measured, observables),
                          .expected = part_of(correlation_.expected, observables)}});
  }
  for (const Observable& observable : problem.observables) counts_.push_back(observable.n);
  for (const Experiment& experiment : measured_experiments(problem)) {
    FailureRisk risk(attempts_of(problem, experiment, runs));
    if (risk.any()) risks_.push_back(std::move(risk));
  }
}

void Misfit::inflate_near(const Point& point) {
  for (Surrogate& surrogate : surrogates_) surrogate.inflate_near(point);
}

Misfit Misfit::measuring(const std::vector<double>& means) const {
  Misfit other = *this;
  for (std::size_t i = 0; i < means.size(); ++i) {
    other.targets_[i].value = surrogates_[i].warp().of_expected(means[i]);
  }
  return other;
}

double Misfit::difference(std::size_t observable, const Point& point) const {
  const Expectation w = surrogates_[observable].at(point, false);
  return (w.mean - targets_[observable].value) / std::sqrt(1 / weight(observable) + w.variance);
}

bool Misfit::has_model_errors() const {
  return std::ranges::any_of(targets_, [](const Target& target) { return target.model_sd > 0; });
}

double Misfit::model_variance(std::size_t observable) const {
  return std::pow(model_scale_ * targets_[observable].model_sd, 2);
}

double Misfit::surrogate_variance_fraction(std::size_t observable, const Point& point) const {
  return surrogates_[observable].at(point, false).variance * weight(observable);
}

double Misfit::weight(std::size_t observable) const {
  const double sd = targets_[observable].sd;
  return 1 / (sd * sd + model_variance(observable));
}

double Misfit::chi2(const Point& point) const {
  const Residuals all = residuals(point, false);
  // The two groups of small residuals come last.
  const std::size_t counted = all.values.size() - surrogates_.size() - parameters_.size();
  double sum = 0;
  for (std::size_t i = 0; i < counted; ++i) sum += all.values[i] * all.values[i];
  return sum;
}

std::vector<CorrelatedPart> Misfit::parts_of(const Together& together, const Point& point,
                                             bool with_jacobian) const {
  std::vector<CorrelatedPart> parts;
  parts.reserve(together.observables.size());
  for (const std::size_t i : together.observables) {
    const Expectation w = surrogates_[i].at(point, with_jacobian);
    const Target& target = targets_[i];
    parts.push_back({w.mean - target.value, target.sd, w.variance, counts_[i], w.mean_gradient,
                     w.variance_gradient, model_variance(i)});
  }
  return parts;
}

void Misfit::add_together(const Together& together, const Point& point, bool with_jacobian,
                          Residuals& all) const {
  const auto& [observables, correlation] = together;
  const std::size_t penalties = all.values.size() - surrogates_.size() - parameters_.size();
  const std::vector<CorrelatedPart> parts = parts_of(together, point, with_jacobian);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const CorrelatedPart& part = parts[k];
    const double own2 = part.measured_sd * part.measured_sd + part.model2;
    const double sigma2 = own2 + part.variance;
    const double distrust = std::sqrt(part.variance / sigma2);
    const std::size_t row = penalties + observables[k];
    all.values[row] = kDistrust * distrust;
    for (std::size_t j = 0; with_jacobian && distrust > 0 && j < point.size(); ++j) {
      all.jacobian[row][j] =
          kDistrust * own2 * part.variance_gradient[j] / (2 * distrust * sigma2 * sigma2);
    }
  }
  const Residuals independent = made_independent(parts, correlation, with_jacobian);
  for (std::size_t k = 0; k < observables.size(); ++k) {
    const auto [value, slope] =
        robust_ ? robust_residual(independent.values[k]) : std::pair{independent.values[k], 1.};
    all.values[observables[k]] = value;
    for (std::size_t j = 0; with_jacobian && j < point.size(); ++j) {
      all.jacobian[observables[k]][j] = slope * independent.jacobian[k][j];
    }
  }
}

void Misfit::add_priors(const Point& point, bool with_jacobian, Residuals& all) const {
  const std::size_t first = surrogates_.size() + risks_.size();
  const std::size_t pull = all.values.size() - parameters_.size();
  for (std::size_t j = 0; j < parameters_.size(); ++j) {
    const Parameter& parameter = parameters_[j];
    all.values[pull + j] = kPull * (point[j] - .5);
    if (with_jacobian) all.jacobian[pull + j][j] = kPull;
    if (!parameter.prior) continue;
    const double width = parameter.max - parameter.min;
    all.values[first + j] =
        (parameter.min + point[j] * width - parameter.prior->mean) / parameter.prior->sd;
    if (with_jacobian) all.jacobian[first + j][j] = width / parameter.prior->sd;
  }
}

Residuals Misfit::residuals(const Point& point, bool with_jacobian) const {
  const std::size_t count = 2 * surrogates_.size() + risks_.size() + 2 * parameters_.size();
  Residuals all{std::vector<double>(count, 0), {}};
  if (with_jacobian) all.jacobian.assign(count, Point(point.size(), 0));
  for (const Together& together : together_) add_together(together, point, with_jacobian, all);
  for (std::size_t i = 0; i < risks_.size(); ++i) {
    const Risk risk = risks_[i].at(point);
    all.values[surrogates_.size() + i] = kFailure * risk.fraction;
    for (std::size_t j = 0; with_jacobian && j < point.size(); ++j) {
      all.jacobian[surrogates_.size() + i][j] = kFailure * risk.gradient[j];
    }
  }
  add_priors(point, with_jacobian, all);
  return all;
}

}  // namespace repose::calibrate
