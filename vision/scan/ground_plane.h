#pragma once

#include <vector>

#include <Eigen/Core>

namespace repose::vision {

/// normal . p = offset; the normal has length 1, and points to the heap's side once that is known.
struct GroundPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
  double noise = 0;  ///< robust standard deviation of its points around it
  double share = 0;  ///< of the evenly spread points that lie on it

  double height(const Eigen::Vector3d& place) const { return normal.dot(place) - offset; }
  GroundPlane turned() const { return {-normal, -offset, noise, share}; }
};

/// Where a cloud lies: its middle, and a length, without the few points far away from it.
struct CloudExtent {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double length = 0;  ///< diagonal of the box that leaves out 1 % on each side
};

/// @param points  one or more
CloudExtent extent_of(const std::vector<Eigen::Vector3d>& points);

/// A part of the points, one in each cell of a grid: as many where the scanner looked twice as
/// where it looked once.
std::vector<Eigen::Vector3d> evenly_spread(const std::vector<Eigen::Vector3d>& points,
                                           const CloudExtent& extent);

/// Planes with many points on them, the one with most first: each found by random triples, points
/// within a hundred and fiftieth of the extent counted by how near they are, then fitted by least
/// squares to what lies within three robust standard deviations of it, and taken out before the
/// next is sought. The same points give the same planes.
/// Source: Fischler & Bolles, Commun. ACM 24 (1981) 381-395 (random sample consensus); Torr &
/// Zisserman, Comput. Vis. Image Underst. 78 (2000) 138-156, sec. 4 (the score).
/// Proved by GroundPlanes.* in tests/vision/scan_ground_test.cpp.
/// @param spread  as evenly_spread() gives them
std::vector<GroundPlane> find_planes(std::vector<Eigen::Vector3d> spread,
                                     const CloudExtent& extent);

/// The least-squares plane through the points within `tolerance` of a plane, repeated with the
/// tolerance that their scatter gives. Fewer than 50 such points leave it as it is.
GroundPlane refined(const GroundPlane& plane, const std::vector<Eigen::Vector3d>& points,
                    double tolerance);

}  // namespace repose::vision
