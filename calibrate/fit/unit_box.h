#pragma once

#include <vector>

#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

/// Shares of the way from min to max.
Point to_unit(const Problem& problem, const std::vector<double>& values);

/// Back, rounded to decimals as Job::values are, within the bounds.
std::vector<double> to_values(const Problem& problem, const Point& point);

/// The value in decimals, of about a millionth of the distance of the bounds, within them.
double rounded(const Parameter& parameter, double value);

/// Those coordinates of a point that an experiment depends on.
Point seen_by(const Experiment& experiment, const Point& point);

/// A job of a round at a point; coordinates without effect are moved to the middle.
Job job_at(const Problem& problem, const Experiment& experiment, const Point& point,
           std::uint64_t seed);

/// About how long a run with these inputs takes, s: the stable time step goes with the root of one
/// over the stiffness, the search for contacts with the number of spheres.
double run_s_of(const Experiment& experiment, const AssumedInputs& inputs);

/// By name; the problem is sound.
const Experiment& experiment_named(const Problem& problem, const std::string& name);

/// Experiments that something was measured of, in the problem's order.
std::vector<Experiment> measured_experiments(const Problem& problem);

}  // namespace repose::calibrate
