#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "vision/scan/ground_plane.h"
#include "vision/scan/heap_search.h"
#include "vision/scan/height_map.h"
#include "vision/scan/slices.h"

namespace repose::vision {

inline constexpr int kSectors = 8;  ///< around the heap, in which the ground's level is compared

double mean_of(std::span<const double> values);  ///< 0 of none
double sd_of(std::span<const double> values);    ///< sample's; 0 of fewer than two

/// A heap that stands on its map, and how well its ground is known.
struct Survey {
  GroundPlane plane;
  ScanFrame frame;
  StandingScan heap;
  double threshold = 0;
  double cut = 0;              ///< of the base's rim
  std::vector<double> levels;  ///< of the sectors around it in which the ground is seen
  double bow = 0;   ///< c of the ground's height c r^2 around the heap's axis, by its fit
  double sunk = 0;  ///< by how much such a ground lies elsewhere below the heap

  double level_sd() const { return sd_of(levels); }
  /// Half-width of the 95 % interval of the height of the heap above its ground: both levels are
  /// as uncertain as a mean of such sectors (GUM, 4.2.3).
  double level_95() const;
  /// Of the circle as large as the base.
  double base_radius() const;
};

/// Height above the ground of a level ledge around the heap's foot that ends in a step, as of a
/// disc that it stands on; below 0: it stands in a hollow. None: its foot is on the ground. Rings
/// of cells around the axis are level and even (0.15 of the ledge's height, beside the noise) over
/// a fifteenth of the base's radius or more and then, within a tenth, at most 0.4 as high: toes and
/// aprons of grains are rougher, or fall away gradually. The convention is our own; its limits are
/// those with which no heap of grains on flat ground was found to have one (60 scans of drawn
/// heaps, tests/bench/scan_accuracy.cpp). A ledge lower than 0.02 of the heap's height is not
/// looked for. Proved by ScannedHeap.ADisc* and ScannedHeap.AHollow* in
/// tests/vision/scanned_heap_test.cpp.
std::optional<double> ledge_around(const Survey& survey);

/// Cells of a map on which the heap has up to 240, and no more than its points are enough for.
MapPlan plan_around(const FoundHeap& found);

/// Fits the ground to what is seen of it around the heap, and draws the map on that.
/// @param is_told  the ground is as a person has said
/// @return  whether a heap stands clear of the ground's roughness
bool survey_heap(const std::vector<Eigen::Vector3d>& points, const FoundHeap& found, bool is_told,
                 Survey& survey);

}  // namespace repose::vision
