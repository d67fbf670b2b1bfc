#include "calibrate/fit/reading_correlation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace repose::calibrate {
namespace {

constexpr int kFewestDegrees = 4;       // degrees of freedom needed to estimate a correlation
constexpr double kMaxCorrelated = .95;  // of a correlation: two readings are never quite identical

/// Pairs of readings from the same runs.
struct Pairs {
  std::vector<double> one;
  std::vector<double> other;
};

/// For each place that has runs with both readings.
std::vector<Pairs> repeats_of(const Surrogate& one, const Surrogate& other) {
  const TrainingSet& of_one = one.training_set();
  const TrainingSet& of_other = other.training_set();
  std::vector<Pairs> repeats;
  if (!of_one.is_stochastic) return repeats;
  std::map<std::size_t, double> others;  // by run
  for (std::size_t k = 0; k < of_other.runs.size(); ++k) {
    others[of_other.runs[k]] = other.warp().warped(of_other.readings[k]);
  }
  std::map<std::pair<Point, RunKind>, Pairs> by_place;
  for (std::size_t k = 0; k < of_one.runs.size(); ++k) {
    const auto found = others.find(of_one.runs[k]);
    if (found == others.end()) continue;
    Pairs& here = by_place[{of_one.places[k], of_one.kind(k)}];
    here.one.push_back(one.warp().warped(of_one.readings[k]));
    here.other.push_back(found->second);
  }
  for (auto& [place, pairs] : by_place) repeats.push_back(std::move(pairs));
  return repeats;
}

double average_of_repeats(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

struct Correlation {
  double value = 0;
  int df = 0;
};

std::optional<Correlation> correlation_of(const Surrogate& one, const Surrogate& other) {
  double aa = 0, bb = 0, ab = 0;
  int df = 0;
  for (const Pairs& pairs : repeats_of(one, other)) {
    const double mean_a = average_of_repeats(pairs.one), mean_b = average_of_repeats(pairs.other);
    for (std::size_t k = 0; k < pairs.one.size(); ++k) {
      const double a = pairs.one[k] - mean_a, b = pairs.other[k] - mean_b;
      aa += a * a;
      bb += b * b;
      ab += a * b;
    }
    df += static_cast<int>(pairs.one.size()) - 1;
  }
  if (df < kFewestDegrees || !(aa * bb > 0)) return std::nullopt;
  return Correlation{std::clamp(ab / std::sqrt(aa * bb), -1., 1.), df};
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
  for (const std::vector<std::size_t>& own : by_experiment(problem)) {
    double squares = 0;
    double variances = 0;
    for (std::size_t a = 0; a < own.size(); ++a) {
      for (std::size_t b = a + 1; b < own.size(); ++b) {
        if (problem.observables[own[a]].has_own_trials ||
            problem.observables[own[b]].has_own_trials) {
          continue;
        }
        const auto found = correlation_of(surrogates[own[a]], surrogates[own[b]]);
        if (!found) continue;
        const double left = 1 - found->value * found->value;
        squares += found->value * found->value;
        variances += left * left / found->df;
        all[own[a]][own[b]] = found->value;
      }
    }
    const double kept = squares > 0 ? std::clamp(1 - variances / squares, 0., kMaxCorrelated) : 0;
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
