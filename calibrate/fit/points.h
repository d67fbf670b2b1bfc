#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// A place in the unit box: parameters as fractions of the way from min to max.
using Point = std::vector<double>;

/// Member `index` of a sequence that fills the unit box evenly, as does every stretch of it.
///
/// Kronecker's additive sequence x_k = frac(1/2 + k / phi^k'), phi the root of x^(d+1) = x + 1:
/// Roberts (2018), "The unreasonable effectiveness of quasirandom sequences". Any number of
/// dimensions; good ones are below 10. Proved by Sequence.* in tests/calibrate.
Point sequence_point(std::size_t index, std::size_t dimensions);

/// Random numbers that are the same on every platform: the standard fixes the engine, not the
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 < u < 1.
  double uniform() { return (static_cast<double>(engine_() >> 11) + .5) * 0x1p-53; }

  /// 0 ... count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// Normal, mean 0, sd 1: Box and Muller (1958), Ann. Math. Stat. 29, 610.
  double normal();

 private:
  std::mt19937_64 engine_;
};

/// Fractions of the way from min to max.
Point to_unit(const Problem& problem, const std::vector<double>& values);

/// Back, rounded to decimals as Job::values are, within the bounds.
std::vector<double> to_values(const Problem& problem, const Point& point);

/// The value rounded to decimals of about a millionth of the bounds' distance, within the bounds.
double rounded(const Parameter& parameter, double value);

/// The coordinates of a point that an experiment depends on.
Point seen_by(const Experiment& experiment, const Point& point);

/// A job of a round at a point; coordinates without effect are set to the middle.
Job job_at(const Problem& problem, const Experiment& experiment, const Point& point,
           std::uint64_t seed);

/// Approximate duration of a run with these inputs, s. The stable time step scales with the size of
/// the grains and the stiffness to the power of -2/5 (2 / sqrt(k / m) of a Hertz contact in an
/// impact: dem/engine/time_step.h), the contact search with the number of spheres, and the number
/// of grains that fill a vessel with one over the cube of their size.
double run_s_of(const Experiment& experiment, const AssumedInputs& inputs);

/// Likewise for most of its runs.
double usual_run_s(const Experiment& experiment);

/// By name; the problem must be sound.
const Experiment& experiment_named(const Problem& problem, const std::string& name);

/// Experiments with a measured observable, in the problem's order.
std::vector<Experiment> measured_experiments(const Problem& problem);

}  // namespace repose::calibrate
