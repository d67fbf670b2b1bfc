#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/measure/flank.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/height_map.h"
#include "vision/scan/scanned_heap.h"

namespace repose::vision {

/// A heap on its height map.
struct StandingScan {
  HeightMap map;
  std::vector<std::uint8_t> base;  ///< the cells above the threshold, including holes
  Eigen::Vector2d axis = Eigen::Vector2d::Zero();
  double height = 0;  ///< of the crest, on the lightly smoothed map
};

/// Sets the crest's height and the axis, from map and base.
void set_crest_and_axis(StandingScan& heap);

/// The same heap with all heights changed by `rise`.
StandingScan lifted(const StandingScan& heap, double rise);

struct Slice {
  Azimuth azimuth;
  FlankFit fit;
  double reach = 0;  ///< cells from the axis to the base's end
};

/// The heap's flanks along all half-planes.
struct Slices {
  std::vector<Slice> all;
  std::vector<NamedAngle> definitions;  ///< means over the opposite half-planes; only if requested

  std::vector<double> angles() const;  ///< of those with an angle
  std::optional<double> mean() const;
  /// Mean over those with an angle.
  template <typename Value>
  double mean_of(const Value& value) const {
    double sum = 0;
    int count = 0;
    for (const Slice& slice : all) {
      if (!slice.azimuth.angle_rad) continue;
      sum += value(slice.fit);
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }
};

Slices slices_of(const StandingScan& heap, const ScanOptions& options,
                 bool has_definitions = false);

/// Mean height of the heap at each distance from its axis, in steps of one cell, as long as at
/// least half of the azimuths are on its base.
std::vector<Point> mean_profile(const StandingScan& heap);

}  // namespace repose::vision
