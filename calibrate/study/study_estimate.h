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

/// What a study will simulate, estimated before it begins.
namespace repose::calibrate {

/// Phases of a study, in order.
enum class Phase {
  first_round,
  later_rounds,
  equal_sets,  ///< that seem to fit as well as the best one
  checks,      ///< the best fit with fresh seeds
  held_out,    ///< predictions of held-out readings
  stiffness,   ///< grains stiffer than the study's
  spheres,     ///< grains of more spheres
  inputs,      ///< inputs held fixed, varied
};

inline constexpr std::array kPhases{Phase::first_round, Phase::later_rounds, Phase::equal_sets,
                                    Phase::checks,      Phase::held_out,     Phase::stiffness,
                                    Phase::spheres,     Phase::inputs};

/// For users: "later rounds".
std::string_view name_of(Phase phase);

struct PhaseWork {
  int runs = 0;
  double seconds = 0;  ///< by the program's own measure, see Experiment::run_s
};

/// Of one experiment. A fit that has settled ends earlier, and its greatest needs are not known
/// yet: the fit's numbers are about right in total, the others are upper limits.
struct ExperimentEstimate {
  std::string experiment;
  double run_s = 0;  ///< by the program's own measure
  std::map<Phase, PhaseWork> phases = {};

  PhaseWork of(Phase phase) const;
  int fit_runs() const;
  PhaseWork all() const;
};

std::vector<ExperimentEstimate> estimate_of(const Problem& problem, const Budget& asked);

/// All of it in one line, with each phase's share of the work: "at most 291 simulations, with their
/// shares of the work: first round 31 (9 %), ...".
std::string foreseen(const std::vector<ExperimentEstimate>& estimates);

/// Work of at most `rounds` rounds of checks, the last or an earlier one of which is enlarged, s by
/// the program's own measure.
double checks_s(const Problem& problem, const Budget& budget, int rounds);

/// Work after the last check, likewise: predictions of what is held out, stiffer grains, grains of
/// more spheres, fixed inputs varied.
double last_runs_s(const Problem& problem, int repeats);

/// Runs of each experiment that these seconds buy, in the order of estimate_of; excludes those held
/// out, which come last there.
std::vector<int> runs_for(const Problem& problem, double seconds);

/// Progress of a timed run of a bulk experiment.
struct WorkLook {
  double seconds = 0;
  double clump_steps = 0;
};

/// Estimated total duration, s, from the pace in the second half of the time observed: the few
/// grains at the beginning run faster than the many later on. std::nullopt: nothing was done yet.
/// `all_clump_steps`: as many steps of few grains as take as long, see dem::many_grains_factor.
std::optional<double> foreseen_s(const std::vector<WorkLook>& looks, double all_clump_steps);

/// Makes a run, for `longest_s` at most, and saves nothing. Returns the estimated total duration on
/// a core of this machine, s: for an interrupted bulk run from the grain steps it completed and the
/// total number that `run_s` implies; for other experiments from their progress.
/// @throws dem::Interrupted  `is_interrupted` became true.
double timed_run_s(const RunSpec& spec, std::uint64_t seed, double run_s, double longest_s,
                   const std::atomic<bool>& is_interrupted);

}  // namespace repose::calibrate
