#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "cli/simulate/simulate_runs.h"

/// Which number of a repeat is its value.
namespace repose::cli {

/// Where the repeats' values are from: "pictures", "positions", or "mixed" (see
/// calibrate::is_from_pictures, which each repeat decides on its own).
std::string source_of(const std::vector<Run>& runs);

/// The repeats' values, in their order.
std::vector<double> values_of(const std::vector<Run>& runs);

/// Mean and scatter of the repeats' values; none when one of them is no number. Values that are all
/// the same to the last bit, as where nothing is left to chance, have a mean but no scatter: an
/// interval of no width would claim what was not found out.
std::optional<calibrate::Summary> summarise(const std::vector<Run>& runs);

/// The two sources of a heap's angle beside each other, in degrees.
struct HeapAngles {
  calibrate::Summary positions;  ///< over repeats
  std::optional<calibrate::Summary>
      pictures;                        ///< over repeats; none when one of them has no number
  double between_views_positions = 0;  ///< standard deviation, mean of the repeats
  std::optional<double> between_views_pictures;  ///< as above; none with a single view
  int views = 0;                                 ///< of all repeats together
  int refused = 0;
  int flagged = 0;
  int pictured = 0;  ///< repeats whose value is from pictures
};

/// None when no pictures were taken.
std::optional<HeapAngles> heap_angles(const std::vector<Run>& runs);

}  // namespace repose::cli
