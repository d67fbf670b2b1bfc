#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"

/// Predicted readings at given parameters, from surfaces through existing runs.
namespace repose::calibrate {

/// One reading at one place, in its unit.
struct ReadingAt {
  std::string name;
  std::string unit;
  double value = 0;        ///< expected
  Interval interval;       ///< 95 %, of one further run there
  Interval mean_interval;  ///< 95 %, of the mean of very many
};

/// A problem and its existing runs.
struct KnownRuns {
  Problem problem;
  std::vector<Run> runs;
  std::vector<std::string> notes = {};  ///< remarks on these
};

/// Those of a study that was calibrated with simulations of this program.
/// @throws base::InputError  the folder has no result, or that of another study.
KnownRuns known_runs_in(const std::filesystem::path& folder);

/// Places in a table with columns named after the parameters, with or without the prefix
/// "contact.". Other columns are skipped.
/// @throws base::InputError  every error: columns that are missing, cells that are not numbers, or
///   places outside the bounds, where the surfaces are not valid.
std::vector<std::vector<double>> places_in(const std::filesystem::path& file,
                                           const std::vector<Parameter>& parameters);

/// Each reading, fitted or held out, at each place. Formulae and reasons: fit/THEORY.md, "Readings
/// at given parameters". Proved by PredictedReadings.* in tests/calibrate.
/// @throws base::InputError  fewer than three runs have a reading.
std::vector<std::vector<ReadingAt>> predicted_readings(
    const KnownRuns& known, const std::vector<std::vector<double>>& places);

}  // namespace repose::calibrate
