#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/particles/standing_heap.h"
#include "dem/study/config.h"
#include "dem/study/study.h"

/// Studies of the user's own runs, made with any program: parameters of any name, numbers measured
/// on a bench, and a table with the results of the runs.
namespace repose::calibrate {

/// How a reading is measured if the table has pictures or particles of the runs in place of
/// numbers.
struct PicturedReading {
  std::string definition = {};  ///< of base/angle_definition.h; empty: not stated
  HeapPlacement placement = {};
};

/// The program that makes the runs of a study: its section [engine].
struct EngineSettings {
  std::string command;
  std::optional<double> timeout_s = {};  ///< per run
  std::optional<int> max_runs = {};
  std::optional<int> check_runs = {};  ///< at the fitted parameters, after a fit; 0: none
  dem::ConfigValue settings = {};      ///< passed to the program without interpretation
};

/// [parameter], [measured] and [engine] of a study.
struct TableStudy {
  std::filesystem::path file;
  dem::StudyHeading heading;
  std::vector<Parameter> parameters;  ///< in the order of the file
  std::vector<Observable> measured;   ///< likewise; each is its own experiment's "value"
  std::vector<Observable> held_out;   ///< predicted, not fitted
  std::map<std::string, PicturedReading> pictured;  ///< by reading; for all angles
  std::optional<EngineSettings> engine;             ///< std::nullopt: runs are made by hand
  std::vector<std::filesystem::path> sheets;        ///< of readings, named in the study
  std::vector<std::string> notes;                   ///< assumptions made
  std::string text;                                 ///< of the file
  std::vector<std::string> settings;                ///< overrides of the file
};

/// Whether a study file has its own parameters in place of a particle's coefficients. False if it
/// cannot be read.
bool is_table_study(const std::filesystem::path& file);

/// @param settings  as for dem::read_study
/// @throws base::InputError  every error of the file: line, column, value, rule, fix.
TableStudy read_table_study(const std::filesystem::path& file,
                            const std::vector<std::string>& settings = {});

/// The heading alone, for a copy whose sheets are missing.
/// @throws base::InputError  the file cannot be read.
dem::StudyHeading heading_of_table_study(const std::filesystem::path& file);

/// All measured names: fitted, then held out.
std::vector<std::string> readings_of(const TableStudy& study);

}  // namespace repose::calibrate
