#include "vision/scan/height_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>

namespace repose::vision {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<std::pair<int, int>, 4> kFour = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
constexpr std::array<std::pair<int, int>, 8> kEight = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

bool is_wanted(std::size_t number, Points which) {
  if (which == Points::all) return true;
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;  // Fibonacci hashing (Knuth, vol. 3, 6.4)
  const bool is_odd = ((number * kGolden) >> 40 & 1) != 0;
  return is_odd == (which == Points::odd);
}

constexpr std::size_t kParts = 3;  // of a cell along each of its sides

/// A point within its cell.
struct PlacedPoint {
  float height = 0;
  std::uint8_t part = 0;  ///< of the cell
};

float median_height(std::span<PlacedPoint> points, std::vector<float>& scratch) {
  scratch.clear();
  for (const PlacedPoint& point : points) scratch.push_back(point.height);
  const auto middle = scratch.begin() + std::ssize(scratch) / 2;
  std::nth_element(scratch.begin(), middle, scratch.end());
  if (scratch.size() % 2 != 0) return *middle;
  return (*middle + *std::max_element(scratch.begin(), middle)) / 2;
}

/// Mean over the cell's parts of the mean of their points, excluding points farther from the median
/// than four robust standard deviations.
float height_of(std::span<PlacedPoint> points, std::vector<float>& scratch) {
  constexpr std::size_t kFewToJudge = 4;
  constexpr float kFarthest = 4 * 1.4826F;
  const float middle = median_height(points, scratch);
  if (points.size() < kFewToJudge) return middle;
  for (float& height : scratch) height = std::abs(height - middle);
  const auto half = scratch.begin() + std::ssize(scratch) / 2;
  std::nth_element(scratch.begin(), half, scratch.end());
  const float farthest = kFarthest * *half;
  std::array<double, kParts * kParts> sum{};
  std::array<int, kParts * kParts> count{};
  for (const PlacedPoint& point : points) {
    if (std::abs(point.height - middle) > farthest) continue;
    sum.at(point.part) += static_cast<double>(point.height);
    ++count.at(point.part);
  }
  double mean = 0;
  int parts = 0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count.at(k) == 0) continue;
    mean += sum.at(k) / count.at(k);
    ++parts;
  }
  return parts > 0 ? static_cast<float>(mean / parts) : middle;
}

/// The part of its cell that a place lies in.
std::uint8_t part_of_cell(const MapPlan& plan, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = (place - plan.corner) / plan.cell;
  const auto part = [](double along) {
    const double parts = static_cast<double>(kParts) * (along - std::floor(along));
    return std::min(kParts - 1, static_cast<std::size_t>(parts));
  };
  return static_cast<std::uint8_t>(part(at.y()) * kParts + part(at.x()));
}

/// Sets each cell's height and number of points.
void fill_cells(const std::vector<Eigen::Vector3d>& points, const ScanFrame& frame, double lowest,
                Points which, HeightMap& map) {
  const std::size_t cells = map.height.size();
  std::vector<std::pair<std::uint32_t, PlacedPoint>> placed;
  std::vector<std::uint32_t> below(cells, 0);
  placed.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!is_wanted(k, which)) continue;
    const Eigen::Vector3d place = frame.inside(points[k]);
    const std::size_t cell = map.cell_of(place.head<2>());
    if (cell == cells) continue;
    if (place.z() < lowest) {
      ++below[cell];
      continue;
    }
    placed.emplace_back(static_cast<std::uint32_t>(cell),
                        PlacedPoint{.height = static_cast<float>(place.z()),
                                    .part = part_of_cell(map.plan, place.head<2>())});
    ++map.points[cell];
  }
  std::vector<std::size_t> begin(cells + 1, 0);
  for (std::size_t k = 0; k < cells; ++k) begin[k + 1] = begin[k] + map.points[k];
  std::vector<PlacedPoint> sorted(placed.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const auto& [cell, point] : placed) sorted[next[cell]++] = point;
  std::vector<float> scratch;
  for (std::size_t k = 0; k < cells; ++k) {
    if (map.points[k] <= below[k]) continue;  // none, or stray points above something lower
    map.height[k] = height_of(std::span(sorted).subspan(begin[k], map.points[k]), scratch);
    map.kind[k] = CellKind::seen;
  }
}

/// Calls `call` for each of the cell's neighbours on the map.
template <typename Call>
void for_neighbours(const HeightMap& map, std::size_t cell, const auto& steps, const Call& call) {
  const auto across = static_cast<std::size_t>(map.side());
  const int x = static_cast<int>(cell % across), y = static_cast<int>(cell / across);
  for (const auto& [dx, dy] : steps) {
    if (map.has(x + dx, y + dy)) call(map.at(x + dx, y + dy));
  }
}

/// For two points the median is their mean: if one of them hangs in the air, the cell deviates from
/// its surroundings by more than these vary, and is marked as not seen.
void drop_spikes(HeightMap& map) {
  constexpr std::uint32_t kFewPoints = 2;
  constexpr int kFewestAround = 5;
  std::vector<std::size_t> spikes;
  for (std::size_t k = 0; k < map.height.size(); ++k) {
    if (map.kind[k] != CellKind::seen || map.points[k] > kFewPoints) continue;
    float low = map.height[k], high = map.height[k];
    int around = 0;
    for_neighbours(map, k, kEight, [&](std::size_t other) {
      if (map.kind[other] != CellKind::seen || map.points[other] <= kFewPoints) return;
      low = around == 0 ? map.height[other] : std::min(low, map.height[other]);
      high = around == 0 ? map.height[other] : std::max(high, map.height[other]);
      ++around;
    });
    const float off = std::max(map.height[k] - high, low - map.height[k]);
    if (around >= kFewestAround && off > high - low) spikes.push_back(k);
  }
  for (const std::size_t cell : spikes) {
    map.height[cell] = kNothing;
    map.kind[cell] = CellKind::outside;
  }
}

/// Fills the gaps that scanners leave between their points.
void fill_small_gaps(HeightMap& map) {
  constexpr int kRounds = 3;
  constexpr int kMostOfThem = 5;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<std::size_t, float>> found;
    for (int y = 0; y < map.side(); ++y) {
      for (int x = 0; x < map.side(); ++x) {
        if (map.kind[map.at(x, y)] == CellKind::seen) continue;
        float sum = 0;
        int seen = 0;
        for (const auto& [dx, dy] : kEight) {
          if (!map.has(x + dx, y + dy)) continue;
          const std::size_t other = map.at(x + dx, y + dy);
          if (map.kind[other] != CellKind::seen) continue;
          sum += map.height[other];
          ++seen;
        }
        if (seen >= kMostOfThem) found.emplace_back(map.at(x, y), sum / static_cast<float>(seen));
      }
    }
    for (const auto& [cell, height] : found) {
      map.height[cell] = height;
      map.kind[cell] = CellKind::seen;
    }
  }
}

/// Cells reachable from the map's rim through cells that satisfy `passes`.
template <typename Passes>
std::vector<std::uint8_t> reached_from_rim(const HeightMap& map, const Passes& passes) {
  std::vector<std::uint8_t> reached(map.height.size(), 0);
  std::vector<std::size_t> open;
  const auto add = [&](std::size_t cell) {
    if (reached[cell] != 0 || !passes(cell)) return;
    reached[cell] = 1;
    open.push_back(cell);
  };
  for (int k = 0; k < map.side(); ++k) {
    for (const std::size_t cell :
         {map.at(k, 0), map.at(k, map.side() - 1), map.at(0, k), map.at(map.side() - 1, k)}) {
      add(cell);
    }
  }
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    for_neighbours(map, cell, kFour, add);
  }
  return reached;
}

/// Solves Laplace's equation in the holes, which continues slopes from both sides: Gauss-Seidel
/// relaxation, initialised from the rim inwards.
void fill_holes(HeightMap& map) {
  const auto reached =
      reached_from_rim(map, [&](std::size_t cell) { return map.kind[cell] != CellKind::seen; });
  std::vector<std::size_t> holes;
  for (std::size_t k = 0; k < map.height.size(); ++k) {
    if (map.kind[k] == CellKind::seen || reached[k] != 0) continue;
    map.kind[k] = CellKind::hole;
    holes.push_back(k);
  }
  std::vector<std::size_t> open = holes, later;
  while (!open.empty()) {
    std::vector<std::pair<std::size_t, float>> found;
    later.clear();
    for (const std::size_t cell : open) {
      float sum = 0;
      int known = 0;
      for_neighbours(map, cell, kFour, [&](std::size_t other) {
        if (std::isnan(map.height[other])) return;
        sum += map.height[other];
        ++known;
      });
      if (known > 0) {
        found.emplace_back(cell, sum / static_cast<float>(known));
      } else {
        later.push_back(cell);
      }
    }
    if (found.empty()) break;
    for (const auto& [cell, height] : found) map.height[cell] = height;
    std::swap(open, later);
  }
  constexpr int kSweeps = 400;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const std::size_t cell : holes) {
      float sum = 0;
      int known = 0;
      for_neighbours(map, cell, kFour, [&](std::size_t other) {
        sum += map.height[other];
        ++known;
      });
      map.height[cell] = sum / static_cast<float>(known);
    }
  }
}

/// The cells connected to `first`; removes them from `open`.
std::vector<std::size_t> taken_together(const HeightMap& map, std::size_t first,
                                        std::vector<std::uint8_t>& open) {
  std::vector<std::size_t> cells = {first};
  open[first] = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for_neighbours(map, cells[k], kEight, [&](std::size_t other) {
      if (open[other] == 0) return;
      open[other] = 0;
      cells.push_back(other);
    });
  }
  return cells;
}

Region region_of(const HeightMap& map, std::vector<std::size_t> cells) {
  Region region{.cells = std::move(cells), .volume = 0, .highest = 0, .cut = 0};
  std::sort(region.cells.begin(), region.cells.end());
  std::vector<float> heights;
  int rim = 0, cut = 0;
  for (const std::size_t cell : region.cells) {
    region.volume += map.height[cell] * map.plan.cell * map.plan.cell;
    heights.push_back(map.height[cell]);
    int neighbours = 0, outside = 0, others = 0;
    for_neighbours(map, cell, kFour, [&](std::size_t other) {
      ++neighbours;
      outside += map.kind[other] == CellKind::outside ? 1 : 0;
      others += std::binary_search(region.cells.begin(), region.cells.end(), other) ? 0 : 1;
    });
    const bool is_cut = outside > 0 || neighbours < static_cast<int>(kFour.size());
    rim += others > 0 || is_cut ? 1 : 0;
    cut += is_cut ? 1 : 0;
  }
  region.cut = rim > 0 ? static_cast<double>(cut) / rim : 0;
  const auto one_in_100 =
      heights.begin() + static_cast<std::ptrdiff_t>(heights.size() - 1 - heights.size() / 100);
  std::nth_element(heights.begin(), one_in_100, heights.end());
  region.highest = *one_in_100;
  return region;
}

}  // namespace

ScanFrame::ScanFrame(const GroundPlane& plane, const Eigen::Vector3d& middle) : up(plane.normal) {
  origin = middle - plane.height(middle) * up;
  int flattest = 0;
  up.cwiseAbs().minCoeff(&flattest);
  u = (Eigen::Vector3d::Unit(flattest) - up[flattest] * up).normalized();
  v = up.cross(u);
}

std::size_t HeightMap::cell_of(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d at = (place - plan.corner) / plan.cell;
  const bool is_on_it = at.x() >= 0 && at.y() >= 0 && at.x() < side() && at.y() < side();
  return is_on_it ? this->at(static_cast<int>(at.x()), static_cast<int>(at.y())) : height.size();
}

double HeightMap::height_at(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d from = (place - plan.corner) / plan.cell - Eigen::Vector2d(.5, .5);
  const double x = std::floor(from.x()), y = std::floor(from.y());
  if (!(x >= 0 && y >= 0 && x + 1 < side() && y + 1 < side())) return std::nan("");
  const int i = static_cast<int>(x), k = static_cast<int>(y);
  const double a = from.x() - x, b = from.y() - y;
  return (1 - b) * ((1 - a) * height[at(i, k)] + a * height[at(i + 1, k)]) +
         b * ((1 - a) * height[at(i, k + 1)] + a * height[at(i + 1, k + 1)]);
}

HeightMap height_map(const std::vector<Eigen::Vector3d>& points, const ScanFrame& frame,
                     const MapPlan& plan, double lowest, Points which) {
  const std::size_t cells =
      static_cast<std::size_t>(plan.side) * static_cast<std::size_t>(plan.side);
  HeightMap map{.plan = plan,
                .height = std::vector<float>(cells, kNothing),
                .kind = std::vector<CellKind>(cells, CellKind::outside),
                .points = std::vector<std::uint32_t>(cells, 0)};
  fill_cells(points, frame, lowest, which, map);
  drop_spikes(map);
  fill_small_gaps(map);
  fill_holes(map);
  return map;
}

std::vector<float> smoothed(const HeightMap& map, int reach) {
  std::vector<float> smooth(map.height.size(), kNothing);
  for (int y = 0; y < map.side(); ++y) {
    for (int x = 0; x < map.side(); ++x) {
      if (std::isnan(map.height[map.at(x, y)])) continue;
      double sum = 0;
      int count = 0;
      for (int j = std::max(0, y - reach); j <= std::min(map.side() - 1, y + reach); ++j) {
        for (int i = std::max(0, x - reach); i <= std::min(map.side() - 1, x + reach); ++i) {
          const float height = map.height[map.at(i, j)];
          if (std::isnan(height)) continue;
          sum += static_cast<double>(height);
          ++count;
        }
      }
      smooth[map.at(x, y)] = static_cast<float>(sum / count);
    }
  }
  return smooth;
}

std::vector<Region> regions_above(const HeightMap& map, double threshold, std::size_t fewest) {
  std::vector<std::uint8_t> open(map.height.size(), 0);
  for (std::size_t k = 0; k < open.size(); ++k) {
    open[k] = static_cast<double>(map.height[k]) > threshold ? 1 : 0;
  }
  std::vector<Region> regions;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (open[k] == 0) continue;
    std::vector<std::size_t> cells = taken_together(map, k, open);
    if (cells.size() >= fewest) regions.push_back(region_of(map, std::move(cells)));
  }
  std::stable_sort(regions.begin(), regions.end(),
                   [](const Region& a, const Region& b) { return a.volume > b.volume; });
  return regions;
}

std::vector<std::uint8_t> mask_of(const HeightMap& map, const Region& region) {
  std::vector<std::uint8_t> mask(map.height.size(), 0);
  for (const std::size_t cell : region.cells) mask[cell] = 1;
  const auto reached = reached_from_rim(map, [&](std::size_t cell) { return mask[cell] == 0; });
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = reached[k] != 0 ? 0 : 1;
  return mask;
}

std::vector<std::uint8_t> dilated(const HeightMap& map, const std::vector<std::uint8_t>& mask,
                                  int reach) {
  std::vector<std::uint8_t> wide = mask;
  for (int y = 0; y < map.side(); ++y) {
    for (int x = 0; x < map.side(); ++x) {
      if (mask[map.at(x, y)] == 0) continue;
      for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
          if (i * i + j * j <= reach * reach && map.has(x + i, y + j))
            wide[map.at(x + i, y + j)] = 1;
        }
      }
    }
  }
  return wide;
}

}  // namespace repose::vision
