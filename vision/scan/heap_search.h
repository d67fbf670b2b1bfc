#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/scan/ground_plane.h"

namespace repose::vision {

/// Where the heap is, roughly.
struct FoundHeap {
  GroundPlane plane;  ///< its normal on the heap's side
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 0;  ///< half of the longer side of the box around it
  double area = 0;    ///< of its base, where it was seen
  double points = 0;  ///< on it
  int others = 0;     ///< smaller bodies beside it
};

struct HeapSearch {
  std::optional<FoundHeap> heap;
  std::string reason;  ///< why there is none, and what to do
};

/// Looks for the body that stands alone on the ground: one search for each plane that may be the
/// ground, the one with most points first; a wall or a floor can have more than the table.
/// @param told  the ground, where a person has given it; else it is found
/// @returns one or more
std::vector<HeapSearch> find_heaps(const std::vector<Eigen::Vector3d>& points,
                                   const CloudExtent& extent,
                                   const std::optional<GroundPlane>& told);

}  // namespace repose::vision
