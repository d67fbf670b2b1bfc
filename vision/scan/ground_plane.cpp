#include "vision/scan/ground_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "base/random.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {

namespace {

constexpr std::size_t kSample = 200'000;
constexpr double kTolerance = 1.0 / 150;  // of the extent: more than a scanner's noise
constexpr std::uint64_t kPlaneSeed = 1;

/// An even subset of at most kSample points.
std::vector<Eigen::Vector3d> some_of(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() <= kSample) return points;
  std::vector<Eigen::Vector3d> some;
  some.reserve(kSample);
  for (std::size_t k = 0; k < kSample; ++k) some.push_back(points[k * points.size() / kSample]);
  return some;
}

std::optional<GroundPlane> plane_through(const std::array<Eigen::Vector3d, 3>& places) {
  const Eigen::Vector3d one = places[1] - places[0], other = places[2] - places[0];
  const Eigen::Vector3d normal = one.cross(other);
  const double longest = std::max(one.squaredNorm(), other.squaredNorm());
  if (!(normal.norm() > 1e-3 * longest)) return std::nullopt;
  GroundPlane plane;
  plane.normal = normal.normalized();
  plane.offset = plane.normal.dot(places[0]);
  return plane;
}

/// Sum over the points of their closeness: 1 on the plane, 0 from the tolerance on.
double score(const GroundPlane& plane, const std::vector<Eigen::Vector3d>& points,
             std::size_t stride, double tolerance) {
  double sum = 0;
  for (std::size_t k = 0; k < points.size(); k += stride) {
    const double t = plane.height(points[k]) / tolerance;
    sum += std::max(0.0, 1 - t * t);
  }
  return sum;
}

std::optional<GroundPlane> best_plane(const std::vector<Eigen::Vector3d>& points,
                                      double tolerance) {
  constexpr int kTriples = 3000;
  constexpr std::size_t kScored = 2000;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kScored);
  base::Random random(kPlaneSeed);
  const auto any = [&] {
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()));
    return points[std::min(at, points.size() - 1)];
  };
  std::optional<GroundPlane> best;
  double best_score = 0;
  for (int k = 0; k < kTriples; ++k) {
    const Eigen::Vector3d a = any(), b = any(), c = any();
    const auto plane = plane_through({a, b, c});
    if (!plane) continue;
    const double points_on_it = score(*plane, points, stride, tolerance);
    if (points_on_it <= best_score) continue;
    best_score = points_on_it;
    best = plane;
  }
  return best;
}

}  // namespace

CloudExtent extent_of(const std::vector<Eigen::Vector3d>& points) {
  const std::vector<Eigen::Vector3d> some = some_of(points);
  CloudExtent extent;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    along.reserve(some.size());
    for (const Eigen::Vector3d& place : some) along.push_back(place[axis]);
    std::sort(along.begin(), along.end());
    const std::size_t cut = along.size() / 100;
    const double low = along[cut], high = along[along.size() - 1 - cut];
    extent.middle[axis] = (low + high) / 2;
    size[axis] = high - low;
  }
  extent.length = size.norm();
  return extent;
}

std::vector<Eigen::Vector3d> evenly_spread(const std::vector<Eigen::Vector3d>& points,
                                           const CloudExtent& extent) {
  constexpr double kCells = 120;        // along the extent
  constexpr double kFarthest = 2;       // extents from the middle: points beyond are outliers
  constexpr std::uint64_t kRow = 1024;  // more than the possible number of cells along an axis
  std::vector<std::pair<std::uint64_t, std::size_t>> cells;
  const std::vector<Eigen::Vector3d> some = some_of(points);
  for (std::size_t k = 0; k < some.size(); ++k) {
    const Eigen::Vector3d at = (some[k] - extent.middle) / extent.length;
    if (!(at.cwiseAbs().maxCoeff() < kFarthest)) continue;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      key = key * kRow + static_cast<std::uint64_t>((at[axis] + kFarthest) * kCells);
    }
    cells.emplace_back(key, k);
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Eigen::Vector3d> spread;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k == 0 || cells[k].first != cells[k - 1].first) spread.push_back(some[cells[k].second]);
  }
  return spread;
}

GroundPlane refined(const GroundPlane& plane, const std::vector<Eigen::Vector3d>& points,
                    double tolerance) {
  constexpr int kRefinements = 8;
  constexpr std::size_t kFewest = 50;
  constexpr double kReach = 3;      // robust standard deviations
  constexpr double kSlowest = 0.5;  // minimum ratio of the tolerance from one round to the next
  GroundPlane best = plane;
  for (int round = 0; round < kRefinements; ++round) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    std::vector<double> off;
    std::vector<const Eigen::Vector3d*> on_it;
    for (const Eigen::Vector3d& place : points) {
      const double height = std::abs(best.height(place));
      if (!(height < tolerance)) continue;
      on_it.push_back(&place);
      off.push_back(height);
      mean += place;
    }
    if (on_it.size() < kFewest) return best;
    mean /= static_cast<double>(on_it.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d* place : on_it) {
      scatter += (*place - mean) * (*place - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    best.normal = normal.dot(best.normal) < 0 ? -normal : normal;
    best.offset = best.normal.dot(mean);
    best.noise = kMadToSigma * median(off);
    best.share = static_cast<double>(on_it.size()) / static_cast<double>(points.size());
    const double smallest = 1e-6 * tolerance;
    tolerance = std::max({kReach * best.noise, kSlowest * tolerance, smallest});
    if (kReach * best.noise >= tolerance && round > kRefinements / 2) break;
  }
  return best;
}

std::vector<GroundPlane> find_planes(std::vector<Eigen::Vector3d> spread,
                                     const CloudExtent& extent) {
  constexpr std::size_t kMostPlanes = 4;
  constexpr double kFewestOfFirst = 0.04;
  constexpr std::size_t kFewestLeft = 100;
  const double tolerance = kTolerance * extent.length;
  const auto all = static_cast<double>(spread.size());
  std::vector<GroundPlane> planes;
  while (planes.size() < kMostPlanes && spread.size() > kFewestLeft) {
    const auto found = best_plane(spread, tolerance);
    if (!found) break;
    GroundPlane plane = refined(*found, spread, tolerance);
    const auto before = static_cast<double>(spread.size());
    std::erase_if(spread, [&](const Eigen::Vector3d& place) {
      return std::abs(plane.height(place)) < tolerance;
    });
    plane.share = (before - static_cast<double>(spread.size())) / all;
    if (!planes.empty() && plane.share < kFewestOfFirst * planes.front().share) break;
    planes.push_back(plane);
  }
  return planes;
}

}  // namespace repose::vision
