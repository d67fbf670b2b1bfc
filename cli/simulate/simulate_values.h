#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "cli/simulate/simulate_runs.h"

/// Which number of a repeat is its value.
namespace repose::cli {

/// Where the repeats' values are from: "pictures", "positions", or "mixed" (see
/// calibrate::is_from_pictures, which each repeat decides on its own).
std::string source_of(const std::vector<Run>& runs);

/// The repeats' values, in their order; none when one of them has none.
std::optional<std::vector<double>> values_of(const std::vector<Run>& runs);

/// Mean and scatter of the repeats' values; none when one of them has none. Values that are all
/// the same to the last bit, as where nothing is left to chance, have a mean but no scatter: an
/// interval of no width would claim what was not found out.
std::optional<calibrate::Summary> summarise(const std::vector<Run>& runs);

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
std::optional<HeapAngles> heap_angles(const std::vector<Run>& runs);

/// Means over the repeats of a heap's angle by each definition that all of them allow; of other
/// experiments none.
std::vector<std::pair<std::string, double>> means_by_definition(const std::vector<Run>& runs);

/// A reading of the repeats that have it, and only of those.
std::vector<double> readings_named(const std::vector<Run>& runs, const std::string& name);

}  // namespace repose::cli
