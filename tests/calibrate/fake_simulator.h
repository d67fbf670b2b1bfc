#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"

// Made-up experiments with the shapes and the scatter of the real ones, that take no time.
namespace repose::calibrate::fake {

/// Restitution, sliding and rolling friction: of grain and wall, then of grain and grain.
std::vector<Parameter> parameters();

/// Values of these that are to be found again.
inline const std::vector<double> kTruth = {.31, .42, .05, .2, .3, .06};

/// drop, tilt, roll depend on the first three parameters, heap on all six; costs as on one core.
std::vector<Experiment> experiments();

/// Expectation of a reading over all seeds: "value", and "base_radius_mm" of the heap,
/// "lowest_point_rise_mm" of the drop.
double expected(const std::string& experiment, const std::string& reading,
                const std::vector<double>& values);

/// Run names something else inside of a gtest test.
using Runs = std::vector<Run>;

/// What a tenth of the stiffness adds to the angle of a heap, degrees.
inline constexpr double kSofteningShift = 2.5;

/// What grains of twice the size add to the angle of a heap, degrees: nothing in the middle, up to
/// -7 with less friction and to -4 with more, as heaps of wheat do (docs/simulating.md, "Heaps of
/// larger grains").
double size_shift(double sliding_friction);

/// What four times the spheres leave of a rebound.
inline constexpr double kFinerRebound = .5;

/// One run with its scatter, softer ones with what that adds, those of more spheres with what that
/// takes, those of larger grains with their shift, scattering more. Heaps of much friction stay in
/// the tube when `jams`.
Run run(const Job& job, bool jams = false);

Runs run_all(const std::vector<Job>& jobs, bool jams = false);

/// Ten readings of each of the four experiments at `truth`, with a bench's own scatter.
std::vector<Observable> measured(const std::vector<double>& truth, std::uint64_t seed);

/// All of the above in one problem.
Problem problem(const std::vector<double>& truth = kTruth, std::uint64_t seed = 1);

/// Gives the heap of a problem coarse runs, of grains so many times their size.
void coarsen(Problem& problem, double size);

/// The runs of the first round, both parts of it.
Runs first_runs(const Problem& problem, bool jams = false);

/// Runs whatever is proposed until nothing more is.
Runs study(const Problem& problem, bool jams = false);

}  // namespace repose::calibrate::fake
