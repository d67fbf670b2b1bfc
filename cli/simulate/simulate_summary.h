#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "cli/simulate/simulate_runs.h"

/// What all repeats say together: which number of each is its value, and what tells against it.
namespace repose::cli {

/// Where the repeats' values are from: "pictures", "positions", or "mixed" (see
/// calibrate::is_from_pictures, which each repeat decides on its own).
std::string source_of(const std::vector<calibrate::RunResult>& runs);

/// The repeats' values, in their order; none when one of them has none.
std::optional<std::vector<double>> values_of(const std::vector<calibrate::RunResult>& runs);

/// Mean and scatter of the repeats' values; none when one of them has none. Values that are all
/// the same to the last bit, as where nothing is left to chance, have a mean but no scatter: an
/// interval of no width would claim what was not found out.
std::optional<calibrate::Summary> summarise(const std::vector<calibrate::RunResult>& runs);

/// The two sources of a heap's angle beside each other, in degrees.
struct HeapAngles {
  /// Over repeats; none when one of them has no number.
  std::optional<calibrate::Summary> positions;
  std::optional<calibrate::Summary> pictures;  ///< as above
  /// Standard deviation, mean of the repeats; none when one of them has none.
  std::optional<double> between_views_positions;
  std::optional<double> between_views_pictures;  ///< as above
  int views = 0;                                 ///< of all repeats together
  int refused = 0;
  int flagged = 0;
  int pictured = 0;  ///< repeats whose value is from pictures
};

/// None when a repeat has no value or no pictures were taken.
std::optional<HeapAngles> heap_angles(const std::vector<calibrate::RunResult>& runs);

/// A reading of the repeats that have it, and only of those.
std::vector<double> readings_named(const std::vector<calibrate::RunResult>& runs,
                                   const std::string& name);

/// A value that a person must look at before using it.
struct RunWarning {
  std::string code;                   ///< fixed word
  std::optional<std::uint64_t> seed;  ///< none: of all repeats together
  std::string message;                ///< sentence
};

/// What the readings of finished repeats tell against their values.
std::vector<RunWarning> warnings_of(const SimulatePlan& plan,
                                    const std::vector<calibrate::RunResult>& runs);

}  // namespace repose::cli
