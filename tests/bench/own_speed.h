#pragma once

#include <string>
#include <vector>

namespace repose::bench {

/// CPU time of one of the sample's single-grain experiments, at its real stiffness: "drop", "tilt"
/// or "roll". One value per round, s.
std::vector<double> single_grain_times(const std::string& experiment, int rounds);

/// CPU time of a clump-step, ns, and contacts per clump.
struct ClumpSteps {
  std::vector<double> times_ns;
  double contacts = 0;
};

/// Of 500 settled clumps, and of many; one thread, run alternately.
struct Growth {
  ClumpSteps few;
  ClumpSteps many;
};
Growth clump_step_growth(int many, int rounds);

/// Wall-clock speed-up of two threads over one, run alternately, with this many settled clumps.
std::vector<double> two_thread_gains(int clumps, int rounds);

}  // namespace repose::bench
