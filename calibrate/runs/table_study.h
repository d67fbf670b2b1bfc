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

/// Studies of somebody's own runs, made with whatever program: parameters of any name, numbers that
/// a bench measured, and a table that says what the runs gave.
namespace repose::calibrate {

/// How a reading is measured where the table has pictures or particles of the runs in place of
/// numbers.
struct PicturedReading {
  std::string definition = {};  ///< of base/angle_definition.h; empty: not said
  HeapPlacement placement = {};
};

/// The program that makes the runs of a study: its section [engine].
struct EngineSettings {
  std::string command;
  std::optional<double> timeout_s = {};  ///< of a run
  std::optional<int> max_runs = {};
  std::optional<int> check_runs = {};  ///< at the fitted parameters, once a fit is made; 0: none
  dem::ConfigValue settings = {};      ///< a table for the program, of which nothing is known here
};

/// [parameter], [measured] and [engine] of a study.
struct TableStudy {
  std::filesystem::path file;
  dem::StudyHeading heading;
  std::vector<Parameter> parameters;  ///< in the order of the file
  std::vector<Observable> measured;   ///< likewise; each is its own experiment's "value"
  std::vector<Observable> held_out;   ///< predicted, not fitted
  std::map<std::string, PicturedReading> pictured;  ///< by the reading; of all angles
  std::optional<EngineSettings> engine;             ///< none: somebody makes the runs by hand
  std::vector<std::filesystem::path> sheets;        ///< of readings, which the study names
  std::vector<std::string> notes;                   ///< what was taken for granted
  std::string text;                                 ///< of the file
  std::vector<std::string> settings;                ///< laid over it
};

/// Whether a study file has parameters of its own in place of a particle's coefficients. False
/// where it cannot be read.
bool is_table_study(const std::filesystem::path& file);

/// @param settings  as of dem::read_study
/// @throws base::InputError  every error of the file: line, column, value, rule, fix.
TableStudy read_table_study(const std::filesystem::path& file,
                            const std::vector<std::string>& settings = {});

/// The heading alone, of a copy beside which its sheets are missing.
/// @throws base::InputError  the file cannot be read.
dem::StudyHeading heading_of_table_study(const std::filesystem::path& file);

/// All measured names: fitted, then held out.
std::vector<std::string> readings_of(const TableStudy& study);

}  // namespace repose::calibrate
