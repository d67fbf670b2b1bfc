#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/study/study_problem.h"

/// What a study will simulate, told before it begins.
namespace repose::calibrate {

/// Of one experiment. A fit that has settled ends earlier, and what it needs most is not known yet:
/// the fit's number is about right in the sum, the other the most there can be.
struct ExperimentEstimate {
  std::string experiment;
  double run_s = 0;    ///< by the program's own measure, see Experiment::run_s
  int fit_runs = 0;    ///< in all rounds of the fit
  int check_runs = 0;  ///< with fresh seeds afterwards, or to predict what is held out
  int varied_runs =
      0;  ///< likewise, with stiffer grains than the study's, more spheres, other inputs
  double varied_s = 0;  ///< all of these
};

std::vector<ExperimentEstimate> estimate_of(const Problem& problem, const Budget& budget);

/// Work of so many rounds of checks at most, s by the program's own measure, and of what makes the
/// last of them, or of those before, a large one.
double checks_s(const Problem& problem, const Budget& budget, int rounds);

/// Work of what follows the last check, likewise: predictions of what is held out, stiffer grains,
/// grains of more spheres, inputs held fixed that are varied.
double last_runs_s(const Problem& problem, int repeats);

/// Runs of each experiment that so many seconds buy, in the order of estimate_of; none of those
/// held out, which come last there.
std::vector<int> runs_for(const Problem& problem, double seconds);

/// Makes a run, for `longest_s` at most, and saves nothing. How long all of it takes on a core of
/// this machine, s: of a run that was broken off, from its progress.
/// @throws dem::Interrupted  `is_interrupted` became true.
double timed_run_s(const RunSpec& spec, std::uint64_t seed, double longest_s,
                   const std::atomic<bool>& is_interrupted);

}  // namespace repose::calibrate
