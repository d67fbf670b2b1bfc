#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/result/result.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"

/// The joint fit of a study to a table of runs: nothing is simulated or checked in simulations,
/// unless an engine makes runs on request.
namespace repose::calibrate {

/// Each reading is an experiment of its own, which depends on all parameters.
Problem problem_of(const TableStudy& study, const TableRuns& table);

/// Minimum number of different places with a reading that a fit needs for each.
std::size_t fewest_places(const Problem& problem);

/// An error for each reading that has fewer.
std::vector<base::Fault> too_few_places(const Problem& problem, const TableRuns& table);

/// Runs at the fitted parameters that the fit has not seen.
struct FreshRuns {
  std::vector<Run> runs;  ///< with a reading; their seeds begin at kFirstCheckSeed
  int failed = 0;         ///< number of others
};

/// Makes such runs, or finds those made before.
/// @param has_chance  other seeds give other readings; if false, one run is enough
using FreshRunsAt = std::function<FreshRuns(const std::vector<double>& values, bool has_chance)>;

/// Fits, and predicts what is held out from surfaces through the table's runs.
/// @param made_by  the engine that made runs of the table; std::nullopt: made by hand
/// @param fresh_runs_at  called for runs that check the fit (verification.h), unless no parameters
///   give the readings; empty: no further runs
/// @throws base::InputError  too few rows have a reading.
StudyResult fit_table(const TableStudy& study, const TableRuns& table,
                      const std::optional<EngineFacts>& made_by = {},
                      const FreshRunsAt& fresh_runs_at = {});

/// What is calibrated: the options of `repose calibrate --runs`.
struct TableRequest {
  std::filesystem::path study;
  std::vector<std::string> settings = {};
  std::vector<std::filesystem::path> runs;
  std::filesystem::path folder = {};  ///< empty: default_folder() of the study
  /// Engine that made the runs, whose caller has locked the folder; std::nullopt: by hand.
  std::optional<EngineFacts> engine = {};
  std::vector<std::string> notes = {};  ///< on how they were made, for the result's warnings
  FreshRunsAt fresh_runs_at = {};       ///< as for fit_table()
};

/// Reads study and tables, fits, and saves a copy of the study and result.json in the folder: the
/// input of `repose report`.
/// @param note  receives remarks on study and rows, a sentence each; may be null
/// @return  std::nullopt if interrupted
/// @throws base::InputError  every error of the study and the tables; a folder with somebody's
///   files, or that cannot be written.
std::optional<StudyResult> calibrate_table(const TableRequest& request,
                                           const std::function<void(const std::string&)>& note,
                                           const std::atomic<bool>& is_interrupted);

}  // namespace repose::calibrate
