#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "cli/simulate/simulate_runs.h"

/// Summary of all repeats: which number of each is its value, and warnings about it.
namespace repose::cli {

/// Source of the repeats' values: "pictures", "positions", or "mixed" (see
/// calibrate::is_from_pictures, decided for each repeat separately).
std::string source_of(const std::vector<calibrate::RunResult>& runs);

/// The repeats' values, in their order; std::nullopt if any has none.
std::optional<std::vector<double>> values_of(const std::vector<calibrate::RunResult>& runs);

/// Mean and scatter of the repeats' values; std::nullopt if any has none. Values that are identical
/// to the last bit, as in deterministic experiments, have a mean but no scatter: an interval of
/// zero width would claim knowledge that is not there.
std::optional<calibrate::Summary> summarise(const std::vector<calibrate::RunResult>& runs);

/// The two sources of a heap's angle side by side, in degrees.
struct HeapAngles {
  /// Over repeats; std::nullopt if any has no number.
  std::optional<calibrate::Summary> positions;
  std::optional<calibrate::Summary> pictures;  ///< as above
  /// Standard deviation, mean of the repeats; std::nullopt if any has none.
  std::optional<double> between_views_positions;
  std::optional<double> between_views_pictures;  ///< as above
  int views = 0;                                 ///< of all repeats together
  int refused = 0;
  int flagged = 0;
  int pictured = 0;  ///< repeats whose value is from pictures
};

/// std::nullopt if a repeat has no value or no pictures were taken.
std::optional<HeapAngles> heap_angles(const std::vector<calibrate::RunResult>& runs);

/// A reading of those repeats that have it.
std::vector<double> readings_named(const std::vector<calibrate::RunResult>& runs,
                                   const std::string& name);

/// A reason for the user to check a value before using it.
struct RunWarning {
  std::string code;                   ///< fixed word
  std::optional<std::uint64_t> seed;  ///< std::nullopt: all repeats together
  std::string message;                ///< sentence
};

/// Warnings about the values of finished repeats, from their readings.
std::vector<RunWarning> warnings_of(const SimulatePlan& plan,
                                    const std::vector<calibrate::RunResult>& runs);

}  // namespace repose::cli
