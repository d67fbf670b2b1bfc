#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/study/study_problem.h"

/// What a study will simulate, told before it begins.
namespace repose::calibrate {

/// What it simulates one after the other.
enum class Phase {
  first_round,
  later_rounds,
  equal_sets,  ///< that seem to fit as well as the best one
  checks,      ///< the best fit with fresh seeds
  held_out,    ///< predictions of it
  stiffness,   ///< grains stiffer than the study's
  spheres,     ///< grains of more spheres
  inputs,      ///< those held fixed, varied
};

inline constexpr std::array kPhases{Phase::first_round, Phase::later_rounds, Phase::equal_sets,
                                    Phase::checks,      Phase::held_out,     Phase::stiffness,
                                    Phase::spheres,     Phase::inputs};

/// For people: "later rounds".
std::string_view name_of(Phase phase);

struct PhaseWork {
  int runs = 0;
  double seconds = 0;  ///< by the program's own measure, see Experiment::run_s
};

/// Of one experiment. A fit that has settled ends earlier, and what it needs most is not known yet:
/// the fit's numbers are about right in the sum, the others the most there can be.
struct ExperimentEstimate {
  std::string experiment;
  double run_s = 0;  ///< by the program's own measure
  std::map<Phase, PhaseWork> phases = {};

  PhaseWork of(Phase phase) const;
  int fit_runs() const;
  PhaseWork all() const;
};

std::vector<ExperimentEstimate> estimate_of(const Problem& problem, const Budget& asked);

/// All of it in one line, with each phase's share of the work: "at most 291 simulations: first
/// round 31 (9 %), ...".
std::string foreseen(const std::vector<ExperimentEstimate>& estimates);

/// Work of so many rounds of checks at most, s by the program's own measure, and of what makes the
/// last of them, or of those before, a large one.
double checks_s(const Problem& problem, const Budget& budget, int rounds);

/// Work of what follows the last check, likewise: predictions of what is held out, stiffer grains,
/// grains of more spheres, inputs held fixed that are varied.
double last_runs_s(const Problem& problem, int repeats);

/// Runs of each experiment that so many seconds buy, in the order of estimate_of; none of those
/// held out, which come last there.
std::vector<int> runs_for(const Problem& problem, double seconds);

/// How far a run of a bulk is that is watched by the clock.
struct WorkLook {
  double seconds = 0;
  double clump_steps = 0;
};

/// How long all of it takes, s, by the pace of the second half of the time that was looked at: few
/// grains at the beginning go faster than the many of later on. None: nothing was done yet.
std::optional<double> foreseen_s(const std::vector<WorkLook>& looks, double all_clump_steps);

/// Makes a run, for `longest_s` at most, and saves nothing. How long all of it takes on a core of
/// this machine, s: of a bulk that was broken off by the grain steps that it did, of which `run_s`
/// says how many there are in all; of other experiments by their progress.
/// @throws dem::Interrupted  `is_interrupted` became true.
double timed_run_s(const RunSpec& spec, std::uint64_t seed, double run_s, double longest_s,
                   const std::atomic<bool>& is_interrupted);

}  // namespace repose::calibrate
