#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"

// Made-up experiments that behave and scatter like the real ones but take no time.
namespace repose::calibrate::fake {

/// Restitution, sliding and rolling friction: particle-wall, then particle-particle.
std::vector<Parameter> parameters();

/// True values of these, to be recovered.
inline const std::vector<double> kTruth = {.31, .42, .05, .2, .3, .06};

/// drop, tilt and roll depend on the first three parameters, heap on all six; costs on one core.
std::vector<Experiment> experiments();

/// Mean of a reading over all seeds: "value", "base_radius_mm" of the heap, "lowest_point_rise_mm"
/// of the drop.
double expected(const std::string& experiment, const std::string& reading,
                const std::vector<double>& values);

/// Inside a gtest test, Run names something else.
using Runs = std::vector<Run>;

/// Amount by which a tenth of the stiffness raises the angle of a heap, degrees.
inline constexpr double kSofteningShift = 2.5;

/// Change in the angle of a heap for grains of twice the size, degrees: 0 at medium friction, down
/// to -7 at low and to -4 at high friction, as for heaps of wheat (docs/simulating.md, "Heaps of
/// larger grains").
double size_shift(double sliding_friction);

/// Fraction of a rebound that remains with four times as many spheres.
inline constexpr double kFinerRebound = .5;

/// One run with its scatter and the effects of reduced stiffness, of more spheres and of larger
/// grains, which also scatter more. If `jams`, heaps with high friction stay in the tube.
Run run(const Job& job, bool jams = false);

Runs run_all(const std::vector<Job>& jobs, bool jams = false);

/// Ten readings of each of the four experiments at `truth`, with laboratory scatter.
std::vector<Observable> measured(const std::vector<double>& truth, std::uint64_t seed);

/// All of the above as one problem.
Problem problem(const std::vector<double>& truth = kTruth, std::uint64_t seed = 1);

/// An experiment of a problem, to be changed.
Experiment& experiment_of(Problem& problem, const std::string& name);

/// Gives the problem's heap coarse runs, with grains `size` times as large.
void coarsen(Problem& problem, double size);

/// Both parts of the first round.
Runs first_runs(const Problem& problem, bool jams = false);

/// Runs proposed jobs until no more are proposed.
Runs study(const Problem& problem, bool jams = false);

}  // namespace repose::calibrate::fake
