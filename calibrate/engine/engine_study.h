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

/// A table study whose runs an engine makes: plans runs, has them made, and plans again until more
/// runs would not narrow the answer or the limit is reached; then fits. Each step is the same as
/// for a user who makes the runs by hand: next_runs(), a table, calibrate_table().
namespace repose::calibrate {

/// The options of `repose calibrate` for a study with [engine].
struct EngineRequest {
  std::filesystem::path study;
  std::vector<std::string> settings = {};
  std::vector<std::filesystem::path> runs = {};  ///< tables of other runs, made before
  std::filesystem::path folder = {};             ///< empty: default_folder() of the study
  int jobs = 1;
  std::optional<int> max_runs =
      {};  ///< 0: only fit the existing runs; std::nullopt: as in the study
};

struct EngineProgress {
  std::size_t made = 0;    ///< finished runs
  std::size_t failed = 0;  ///< of these
  std::size_t asked = 0;   ///< these and those now to be made
  std::size_t most = 0;    ///< maximum number to be made
};

/// Observers, which may also interrupt it. All may be null.
struct EngineWatch {
  std::function<void(const EngineProgress& progress)> report = {};
  std::function<void(const std::string& text)> note = {};
  const std::atomic<bool>* is_interrupted = nullptr;
};

/// What is known before any run is made.
struct EngineForecast {
  std::size_t made = 0;
  std::size_t failed = 0;
  std::size_t next = 0;                   ///< runs to be made next
  std::size_t most = 0;                   ///< in all
  std::optional<double> run_s;            ///< mean of those made; std::nullopt: none was
  std::vector<std::string> settled = {};  ///< why no runs, or fewer, are to be made
};

/// Default maximum number of runs: 32 for two parameters, 40 for three.
int usual_max_runs(std::size_t parameters);

/// Makes runs and fits. Finished runs stay in the folder, and the same request continues from
/// there: the result is that of an uninterrupted calibration, whatever the number of jobs. Proved
/// by EngineStudyTest.* in tests/calibrate.
/// @return  std::nullopt if it was interrupted
/// @throws base::InputError  all errors in study and tables; or none of the first runs has a
///   reading.
std::optional<StudyResult> calibrate_with_engine(const EngineRequest& request,
                                                 const EngineWatch& watch);

/// Makes no runs and changes nothing.
/// @throws base::InputError  as calibrate_with_engine().
EngineForecast forecast_of(const EngineRequest& request);

}  // namespace repose::calibrate
