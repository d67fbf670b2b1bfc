#pragma once

#include <string>
#include <vector>

namespace repose::bench {

/// CPU time of one of the sample's experiments with single grains, at its real stiffness: "drop",
/// "tilt" or "roll". One of each round, s.
std::vector<double> single_grain_times(const std::string& experiment, int rounds);

/// CPU time of a clump-step, ns, and how many contacts each clump has.
struct ClumpSteps {
  std::vector<double> times_ns;
  double contacts = 0;
};

/// Of 500 settled clumps, and of many; one thread, turn about.
struct Growth {
  ClumpSteps few;
  ClumpSteps many;
};
Growth clump_step_growth(int many, int rounds);

/// How much faster two threads are by the clock than one, turn about, with so many settled clumps.
std::vector<double> two_thread_gains(int clumps, int rounds);

}  // namespace repose::bench
