#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/scan/ground_plane.h"

namespace repose::vision {

/// Approximate location of the heap.
struct FoundHeap {
  GroundPlane plane;  ///< its normal points to the heap's side
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 0;  ///< half of the longer side of the box around it
  double area = 0;    ///< area of its base that was seen
  double points = 0;  ///< number of points on it
  int others = 0;     ///< smaller bodies beside it
};

struct HeapSearch {
  std::optional<FoundHeap> heap;
  std::string reason;  ///< why there is none, and what to do
};

/// Looks for the body that stands alone on the ground: one search for each plane that may be the
/// ground, the one with most points first; a wall or a floor may have more than the table.
/// @param told  the ground, if the user gave it; otherwise it is searched for
/// @returns at least one
std::vector<HeapSearch> find_heaps(const std::vector<Eigen::Vector3d>& points,
                                   const CloudExtent& extent,
                                   const std::optional<GroundPlane>& told);

}  // namespace repose::vision
