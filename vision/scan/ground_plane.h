#pragma once

#include <vector>

#include <Eigen/Core>

namespace repose::vision {

/// normal . p = offset; the normal has length 1, and points towards the heap once that is known.
struct GroundPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
  double noise = 0;  ///< robust standard deviation of its points around it
  double share = 0;  ///< fraction of the evenly spread points that lie on it

  double height(const Eigen::Vector3d& place) const { return normal.dot(place) - offset; }
  GroundPlane turned() const { return {-normal, -offset, noise, share}; }
};

/// Position and size of a point cloud: its middle, and a length, ignoring the few distant points.
struct CloudExtent {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double length = 0;  ///< diagonal of the box that excludes 1 % on each side
};

/// @param points  at least one
CloudExtent extent_of(const std::vector<Eigen::Vector3d>& points);

/// A subset of the points, one per grid cell, so that areas scanned twice are as dense as those
/// scanned once.
std::vector<Eigen::Vector3d> evenly_spread(const std::vector<Eigen::Vector3d>& points,
                                           const CloudExtent& extent);

/// Planes with many points, the one with most first: each found by random triples, counting points
/// within 1/150 of the extent, weighted by how near they are; then fitted by least squares to the
/// points within three robust standard deviations of it. Points within 1/150 of the extent are
/// removed before the next search. The same points give the same planes.
/// Source: Fischler & Bolles, Commun. ACM 24 (1981) 381-395 (random sample consensus); Torr &
/// Zisserman, Comput. Vis. Image Underst. 78 (2000) 138-156, sec. 4 (the score).
/// Proved by GroundPlanes.* in tests/vision/scan_ground_test.cpp.
/// @param spread  as returned by evenly_spread()
std::vector<GroundPlane> find_planes(std::vector<Eigen::Vector3d> spread,
                                     const CloudExtent& extent);

/// The least-squares plane through the points within `tolerance` of a plane, repeated with a
/// tolerance derived from their scatter. Fewer than 50 such points leave it unchanged.
GroundPlane refined(const GroundPlane& plane, const std::vector<Eigen::Vector3d>& points,
                    double tolerance);

}  // namespace repose::vision
