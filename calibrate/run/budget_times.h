#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calibrate/run/run_study.h"
#include "calibrate/study/study_estimate.h"

/// What each budget would simulate of a study, and how long that takes on this machine.
namespace repose::calibrate {

/// By the name of the experiment: seconds of a core here for a second of the program's own measure.
using Pace = std::map<std::string, double>;

/// Makes a run of each experiment, coefficients in the middle of their bounds, for `longest_s` at
/// most, and saves nothing. @param timed, is_interrupted  as budget_times()
Pace timed_pace(const PreparedStudy& study, double longest_s,
                const std::atomic<bool>& is_interrupted,
                const std::function<void(std::size_t done, std::size_t of)>& timed = {});

struct BudgetTime {
  Budget budget;
  std::vector<ExperimentEstimate> experiments;
  std::map<Phase, PhaseWork> phases;  ///< of all experiments; seconds here, on all the cores
  double seconds = 0;  ///< at most, likewise; the computation between rounds is extra
};

struct BudgetTimes {
  int cores = 1;
  std::vector<BudgetTime> budgets;  ///< the smallest first; each with the same experiments
  std::vector<double> run_s;        ///< of each experiment, on one core here
  std::vector<int> hour_runs;       ///< of each experiment, that one hour more buys; all the cores'
};

/// Times a run of each experiment, coefficients in the middle of their bounds, and saves nothing.
/// Budgets are the one that the study is to be calibrated with, and "quick" and "standard".
/// @param timed  is told before the first run and after each how many of them are done
/// @throws dem::Interrupted  `is_interrupted` became true.
BudgetTimes budget_times(const PreparedStudy& study, const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t done, std::size_t of)>& timed = {});

/// All of it, for programs.
std::string to_json(const BudgetTimes& times);

}  // namespace repose::calibrate
