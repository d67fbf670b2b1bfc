#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calibrate/run/run_study.h"
#include "calibrate/study/study_estimate.h"

/// What each budget would simulate for a study, and how long that takes on this machine.
namespace repose::calibrate {

/// By experiment: core seconds here per second of the program's own measure.
using Pace = std::map<std::string, double>;

/// Makes a run of each experiment, with coefficients in the middle of their bounds, for `longest_s`
/// at most, and saves nothing. @param timed, is_interrupted  as budget_times()
Pace timed_pace(const PreparedStudy& study, double longest_s,
                const std::atomic<bool>& is_interrupted,
                const std::function<void(std::size_t done, std::size_t of)>& timed = {});

struct BudgetTime {
  Budget budget;
  std::vector<ExperimentEstimate> experiments;
  std::map<Phase, PhaseWork> phases;  ///< of all experiments; seconds here, on all cores
  double seconds = 0;                 ///< at most, likewise; excludes computation between rounds
};

struct BudgetTimes {
  int cores = 1;
  std::vector<BudgetTime> budgets;  ///< a budget of another name, quick, standard
  std::vector<double> run_s;        ///< of each experiment, on one core here
  std::vector<int> hour_runs;       ///< of each experiment, that one more hour on all cores buys
};

/// Times a run of each experiment, with coefficients in the middle of their bounds; saves nothing.
/// Budgets are the one that the study is to be calibrated with, and "quick" and "standard".
/// @param timed  called with the number done before the first run and after each
/// @throws dem::Interrupted  `is_interrupted` became true.
BudgetTimes budget_times(const PreparedStudy& study, const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t done, std::size_t of)>& timed = {});

/// All of it, in machine-readable form.
std::string to_json(const BudgetTimes& times);

}  // namespace repose::calibrate
