#include "vision/scan/heap_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "vision/scan/height_map.h"

namespace repose::vision {

namespace {

constexpr std::size_t kFewestCells = 16;  // of a body
constexpr double kMostCut = 0.35;     // of a body's rim: above it, too little of the body is seen
constexpr double kOtherHeap = 0.2;    // of the largest body's volume, and
constexpr double kOtherHeight = 0.4;  // ... of its height: such a second body is another heap
constexpr double kOtherSide = 0.3;    // of its volume: there is a body below the ground, too

/// What stands on one side of a plane.
struct SideOfGround {
  HeightMap map;
  std::vector<Region> bodies;  ///< enclosed by the ground
  std::vector<Region> cut;     ///< cut off by the scan's edge
  ScanFrame frame;
};

/// A grid over all but the outermost points, with an average of at least six points per cell.
MapPlan plan_of(const std::vector<Eigen::Vector3d>& points, const ScanFrame& frame) {
  constexpr double kPointsPerCell = 6, kBeyond = 1.02;
  constexpr int kMostAcross = 300, kFewestAcross = 24;
  constexpr std::size_t kLooked = 100'000, kOneIn = 200;
  std::array<std::vector<double>, 2> along;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kLooked);
  for (std::size_t k = 0; k < points.size(); k += step) {
    const Eigen::Vector3d place = frame.inside(points[k]);
    along[0].push_back(place.x());
    along[1].push_back(place.y());
  }
  Eigen::Vector2d low, high;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double>& values = along[static_cast<std::size_t>(axis)];
    std::sort(values.begin(), values.end());
    low[axis] = values[values.size() / kOneIn];
    high[axis] = values[values.size() - 1 - values.size() / kOneIn];
  }
  const double side = kBeyond * std::max((high - low).maxCoeff(), 1e-12);
  const Eigen::Vector2d size = high - low;
  const double share = std::max(.05, size.x() * size.y() / (side * side));
  const double cells = static_cast<double>(points.size()) / kPointsPerCell / share;
  const int across = std::clamp(static_cast<int>(std::sqrt(cells)), kFewestAcross, kMostAcross);
  return {.corner = (low + high) / 2 - Eigen::Vector2d::Constant(side / 2),
          .cell = side / across,
          .side = across};
}

SideOfGround look_at(const std::vector<Eigen::Vector3d>& points, const CloudExtent& extent,
                     const GroundPlane& plane) {
  constexpr double kAboveNoise = 3.5, kBelowNoise = 8, kAbove = .004, kBelow = .01;
  const ScanFrame frame(plane, extent.middle);
  const double lowest = -std::max(kBelowNoise * plane.noise, kBelow * extent.length);
  SideOfGround side{.map = height_map(points, frame, plan_of(points, frame), lowest),
                    .bodies = {},
                    .cut = {},
                    .frame = frame};
  const double threshold = std::max(kAboveNoise * plane.noise, kAbove * extent.length);
  for (Region& region : regions_above(side.map, threshold, kFewestCells)) {
    (region.cut < kMostCut ? side.bodies : side.cut).push_back(std::move(region));
  }
  return side;
}

double volume_of(const std::vector<Region>& regions) {
  return regions.empty() ? 0 : regions.front().volume;
}

FoundHeap placed(const SideOfGround& side, const GroundPlane& plane) {
  const Region& body = side.bodies.front();
  FoundHeap heap{.plane = plane};
  double seen = 0;
  Eigen::Vector2d low = side.map.middle(body.cells.front()), high = low;
  for (const std::size_t cell : body.cells) {
    low = low.cwiseMin(side.map.middle(cell));
    high = high.cwiseMax(side.map.middle(cell));
    heap.points += side.map.points[cell];
    seen += side.map.points[cell] > 0 ? 1 : 0;
  }
  const Eigen::Vector2d middle = (low + high) / 2;
  heap.middle = side.frame.outside({middle.x(), middle.y(), 0});
  heap.radius = (high - low).maxCoeff() / 2 + side.map.plan.cell;
  heap.area = seen * side.map.plan.cell * side.map.plan.cell;
  heap.others = static_cast<int>(side.bodies.size()) - 1;
  return heap;
}

/// The heap on a plane, or why there is none.
HeapSearch search_on(const std::vector<Eigen::Vector3d>& points, const CloudExtent& extent,
                     const GroundPlane& plane) {
  SideOfGround above = look_at(points, extent, plane);
  SideOfGround below = look_at(points, extent, plane.turned());
  const bool is_above = volume_of(above.bodies) >= volume_of(below.bodies);
  const SideOfGround& side = is_above ? above : below;
  const SideOfGround& other = is_above ? below : above;
  if (side.bodies.empty()) {
    if (!above.cut.empty() || !below.cut.empty()) {
      return {.heap = {},
              .reason =
                  "what stands on the ground is cut off at the scan's edge. Fix: scan the "
                  "heap from all around, with ground on every side."};
    }
    return {.heap = {},
            .reason =
                "there is ground only: nothing on it is higher than its own roughness. Fix: "
                "check that the scan shows the heap, and its unit."};
  }
  if (volume_of(other.bodies) > kOtherSide * volume_of(side.bodies)) {
    return {.heap = {},
            .reason =
                "it cannot be told which side of the ground is up: there are bodies on both. "
                "Fix: cut what lies below the ground out of the scan."};
  }
  const Region& largest = side.bodies.front();
  const auto is_heap = [&](const Region& body) {
    return body.volume > kOtherHeap * largest.volume &&
           body.highest > kOtherHeight * largest.highest;
  };
  const auto heaps = std::count_if(side.bodies.begin(), side.bodies.end(), is_heap);
  if (heaps > 1) {
    return {.heap = {},
            .reason = fmt::format("{} bodies of like size stand on the ground. Fix: cut the scan "
                                  "down to one heap and the ground around it.",
                                  heaps)};
  }
  return {.heap = placed(side, is_above ? plane : plane.turned()), .reason = {}};
}

}  // namespace

std::vector<HeapSearch> find_heaps(const std::vector<Eigen::Vector3d>& points,
                                   const CloudExtent& extent,
                                   const std::optional<GroundPlane>& told) {
  constexpr double kSmallestGround = 0.05;
  if (told) return {search_on(points, extent, *told)};
  const std::vector<GroundPlane> planes = find_planes(evenly_spread(points, extent), extent);
  if (planes.empty() || planes.front().share < kSmallestGround) {
    return {{.heap = {},
             .reason = fmt::format(
                 "no flat ground is seen. Fix: scan the plate around the heap, too, or give three "
                 "points of it with a {}.",
                 base::field("ground plane"))}};
  }
  std::vector<HeapSearch> searches;
  searches.reserve(planes.size());
  for (const GroundPlane& plane : planes) searches.push_back(search_on(points, extent, plane));
  return searches;
}

}  // namespace repose::vision
