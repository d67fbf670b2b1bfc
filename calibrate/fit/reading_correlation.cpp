#include "calibrate/fit/reading_correlation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace repose::calibrate {
namespace {

constexpr std::size_t kFewestPairs = 5;  // runs with both readings
constexpr double kMostCorrelated = .95;  // of a correlation: two readings are never quite one

using Errors = std::map<std::size_t, double>;  // by run

Errors errors_of(const Surrogate& surrogate) {
  Errors errors;
  const TrainingSet& training_set = surrogate.training_set();
  const std::vector<double> standardised = surrogate.standardised_errors();
  if (!training_set.is_stochastic || training_set.runs.size() != standardised.size()) return errors;
  for (std::size_t k = 0; k < standardised.size(); ++k) {
    errors[training_set.runs[k]] = standardised[k];
  }
  return errors;
}

/// Around zero, which is what errors are expected to be.
struct Correlation {
  double value = 0;
  std::size_t runs = 0;
};

std::optional<Correlation> correlation_of(const Errors& one, const Errors& other) {
  double aa = 0, bb = 0, ab = 0;
  std::size_t runs = 0;
  for (const auto& [run, error] : one) {
    const auto found = other.find(run);
    if (found == other.end()) continue;
    aa += error * error;
    bb += found->second * found->second;
    ab += error * found->second;
    ++runs;
  }
  if (runs < kFewestPairs || !(aa * bb > 0)) return std::nullopt;
  return Correlation{std::clamp(ab / std::sqrt(aa * bb), -1., 1.), runs};
}

}  // namespace

std::vector<std::vector<std::size_t>> by_experiment(const Problem& problem) {
  std::vector<std::vector<std::size_t>> all;
  for (const Experiment& experiment : problem.experiments) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < problem.observables.size(); ++i) {
      if (problem.observables[i].experiment == experiment.name) own.push_back(i);
    }
    if (!own.empty()) all.push_back(std::move(own));
  }
  return all;
}

std::vector<std::vector<double>> reading_correlation_of(const Problem& problem,
                                                        const std::vector<Surrogate>& surrogates) {
  const std::size_t count = surrogates.size();
  std::vector<std::vector<double>> all(count, std::vector<double>(count, 0));
  for (std::size_t i = 0; i < count; ++i) all[i][i] = 1;
  std::vector<Errors> errors;
  for (const Surrogate& surrogate : surrogates) errors.push_back(errors_of(surrogate));
  for (const std::vector<std::size_t>& own : by_experiment(problem)) {
    double squares = 0;
    double variances = 0;
    for (std::size_t a = 0; a < own.size(); ++a) {
      for (std::size_t b = a + 1; b < own.size(); ++b) {
        if (problem.observables[own[a]].has_own_trials ||
            problem.observables[own[b]].has_own_trials) {
          continue;
        }
        const auto found = correlation_of(errors[own[a]], errors[own[b]]);
        if (!found) continue;
        const double left = 1 - found->value * found->value;
        squares += found->value * found->value;
        variances += left * left / static_cast<double>(found->runs - 1);
        all[own[a]][own[b]] = found->value;
      }
    }
    const double kept = squares > 0 ? std::clamp(1 - variances / squares, 0., kMostCorrelated) : 0;
    for (std::size_t a = 0; a < own.size(); ++a) {
      for (std::size_t b = a + 1; b < own.size(); ++b) {
        all[own[a]][own[b]] *= kept;
        all[own[b]][own[a]] = all[own[a]][own[b]];
      }
    }
  }
  return all;
}

}  // namespace repose::calibrate
