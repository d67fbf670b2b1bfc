#include "calibrate/fit/points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace repose::calibrate {

Point sequence_point(std::size_t index, std::size_t dimensions) {
  double phi = 2;
  // x^(d+1) = x + 1 as a fixed point; contracts by at least 1 / (d + 1) each time.
  for (int i = 0; i < 64; ++i) phi = std::pow(1 + phi, 1 / (static_cast<double>(dimensions) + 1));
  Point point;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const double step = std::pow(phi, -static_cast<double>(i + 1));
    double whole = 0;
    point.push_back(std::modf(.5 + static_cast<double>(index + 1) * step, &whole));
  }
  return point;
}

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

Point to_unit(const Problem& problem, const std::vector<double>& values) {
  Point point;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& parameter = problem.parameters[i];
    point.push_back((values[i] - parameter.min) / (parameter.max - parameter.min));
  }
  return point;
}

double rounded(const Parameter& parameter, double value) {
  const double digits = std::ceil(6 - std::log10(parameter.max - parameter.min));
  // Dividing by a power of ten gives the double nearest to the decimal; multiplying by .1 does not.
  const double scale = std::pow(10, std::abs(digits));
  const double decimal =
      digits >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return std::clamp(decimal, parameter.min, parameter.max);
}

std::vector<double> to_values(const Problem& problem, const Point& point) {
  std::vector<double> values;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const Parameter& parameter = problem.parameters[i];
    values.push_back(
        rounded(parameter, parameter.min + point[i] * (parameter.max - parameter.min)));
  }
  return values;
}

Point seen_by(const Experiment& experiment, const Point& point) {
  Point seen;
  for (const std::size_t i : experiment.parameters) seen.push_back(point[i]);
  return seen;
}

Job job_at(const Problem& problem, const Experiment& experiment, const Point& point,
           std::uint64_t seed) {
  Point canonical(problem.parameters.size(), .5);
  for (const std::size_t i : experiment.parameters) canonical[i] = point[i];
  return {.experiment = experiment.name,
          .values = to_values(problem, canonical),
          .seed = experiment.is_stochastic ? seed : problem.settings.seed,
          .inputs = experiment.full};
}

double run_s_of(const Experiment& experiment, const AssumedInputs& inputs) {
  constexpr double kStepsByStiffness = .4;
  const double size = inputs.size / experiment.full.size;
  const double many = size == 1 ? 1 : experiment.many_grains;
  return experiment.run_s * inputs.step.work * std::pow(inputs.stiffness, kStepsByStiffness) *
         (1 + experiment.spheres_share * (inputs.spheres - 1)) / (std::pow(size, 4) * many);
}

double usual_run_s(const Experiment& experiment) {
  return run_s_of(experiment, experiment.usual_inputs());
}

const Experiment& experiment_named(const Problem& problem, const std::string& name) {
  return *std::find_if(problem.experiments.begin(), problem.experiments.end(),
                       [&](const Experiment& experiment) { return experiment.name == name; });
}

std::vector<Experiment> measured_experiments(const Problem& problem) {
  std::vector<Experiment> measured;
  for (const Experiment& experiment : problem.experiments) {
    if (std::any_of(problem.observables.begin(), problem.observables.end(),
                    [&](const Observable& o) { return o.experiment == experiment.name; })) {
      measured.push_back(experiment);
    }
  }
  return measured;
}

}  // namespace repose::calibrate
