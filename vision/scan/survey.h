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

inline constexpr int kSectors = 8;  ///< sectors around the heap in which the ground's level is
                                    ///< compared

double mean_of(std::span<const double> values);  ///< 0 if empty
double sd_of(std::span<const double> values);    ///< sample standard deviation; 0 for fewer than
                                                 ///< two

/// A heap on its map, and how well its ground is known.
struct Survey {
  GroundPlane plane;
  ScanFrame frame;
  StandingScan heap;
  double threshold = 0;
  double cut = 0;              ///< of the base's rim that the scan's edge cuts off, as a fraction
  std::vector<double> levels;  ///< of the sectors around the heap in which the ground is seen
  double bow = 0;   ///< c of the ground's height c r^2 around the heap's axis, from a fit
  double sunk = 0;  ///< how far a ground bent like that would be displaced below the heap

  double level_sd() const { return sd_of(levels); }
  /// Half-width of the 95 % interval of the heap's height above its ground: both levels are as
  /// uncertain as a mean of such sectors (GUM, 4.2.3).
  double level_95() const;
  /// Radius of the circle with the base's area.
  double base_radius() const;
};

/// Height above the ground of a level ledge around the heap's foot that ends in a step, as of a
/// disc under the heap; below 0: the heap stands in a hollow. std::nullopt: its foot is on the
/// ground. Rings of cells around the axis must be level and even (0.15 of the ledge's height, plus
/// the noise) over at least a fifteenth of the base's radius and then, within a tenth, at most 0.4
/// as high: toes and aprons of grains are rougher, or fall away gradually. The convention is our
/// own; its limits are those for which no heap of grains on flat ground was found to have a ledge
/// (60 scans of drawn heaps, tests/bench/scan_accuracy.cpp). A ledge lower than 0.02 of the heap's
/// height is ignored. Proved by ScannedHeap.ADisc* and ScannedHeap.AHollow* in
/// tests/vision/scanned_heap_test.cpp.
std::optional<double> ledge_around(const Survey& survey);

/// A grid with up to 240 cells across the heap, limited by the density of its points.
MapPlan plan_around(const FoundHeap& found);

/// Fits the ground to its visible part around the heap, and draws the map relative to it.
/// @param is_told  the ground was given by the user
/// @return  whether a heap stands clear of the ground's roughness
bool survey_heap(const std::vector<Eigen::Vector3d>& points, const FoundHeap& found, bool is_told,
                 Survey& survey);

}  // namespace repose::vision
