#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/result/result.h"
#include "calibrate/runs/table_study.h"

/// A study of a table whose runs an engine makes: asks for runs, has them made, and asks again,
/// until nothing more would narrow the answer or the limit is reached; then fits. Each step is that
/// of a user who makes the runs by hand: next_runs(), a table, calibrate_table().
namespace repose::calibrate {

/// The options of `repose calibrate` for a study with [engine].
struct EngineRequest {
  std::filesystem::path study;
  std::vector<std::string> settings = {};
  std::vector<std::filesystem::path> runs = {};  ///< tables of other runs, made before
  std::filesystem::path folder = {};             ///< empty: default_folder() of the study
  int jobs = 1;
  std::optional<int> max_runs = {};  ///< 0: none, a fit to those there are; none: as the study says
};

struct EngineProgress {
  std::size_t made = 0;    ///< runs that have ended
  std::size_t failed = 0;  ///< of these
  std::size_t asked = 0;   ///< these and those that are to be made now
  std::size_t most = 0;    ///< that will be made at most
};

/// Who watches, and may stop it. Null: nobody.
struct EngineWatch {
  std::function<void(const EngineProgress& progress)> report = {};
  std::function<void(const std::string& text)> note = {};
  const std::atomic<bool>* is_interrupted = nullptr;
};

/// What is known before anything is made.
struct EngineForecast {
  std::size_t made = 0;
  std::size_t failed = 0;
  std::size_t next = 0;                   ///< runs to be made next
  std::size_t most = 0;                   ///< in all
  std::optional<double> run_s;            ///< mean of those made; none: none was
  std::vector<std::string> settled = {};  ///< why none is to be made, or fewer
};

/// How many runs are made at most where neither the study nor an option says it: for two parameters
/// 32, for three 40.
int usual_max_runs(std::size_t parameters);

/// Makes runs and fits. Whatever was made stays in the folder, and the same request goes on from
/// there: the result is that of a calibration that was not interrupted, at any number of jobs.
/// Proved by EngineStudyTest.* in tests/calibrate.
/// @return  none when it was interrupted
/// @throws base::InputError  every error of study and tables; none of the first runs has a reading.
std::optional<StudyResult> calibrate_with_engine(const EngineRequest& request,
                                                 const EngineWatch& watch);

/// Makes and changes nothing.
/// @throws base::InputError  as calibrate_with_engine().
EngineForecast forecast_of(const EngineRequest& request);

}  // namespace repose::calibrate
