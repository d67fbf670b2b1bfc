#include "vision/scan/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/distributions.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double sd_of(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double Survey::level_95() const {
  if (levels.size() < 2) return 0;
  const auto n = static_cast<double>(levels.size());
  return base::student_t_quantile(.975, n - 1) * std::numbers::sqrt2 * level_sd() / std::sqrt(n);
}

double Survey::base_radius() const {
  const auto cells =
      static_cast<double>(std::count(heap.base.begin(), heap.base.end(), std::uint8_t{1}));
  return heap.map.plan.cell * std::sqrt(cells / std::numbers::pi);
}

MapPlan plan_around(const FoundHeap& found) {
  constexpr double kBeyondHeap = 1.7;   // half of the plan's side, in radii of the heap
  constexpr double kCellsAcross = 240;  // of the heap, if there are enough points
  constexpr double kPointsPerCell = 6;
  const double sparse = std::sqrt(kPointsPerCell * found.area / std::max(1.0, found.points));
  const double cell = std::max(2 * found.radius / kCellsAcross, sparse);
  const double half = kBeyondHeap * found.radius;
  const int side = static_cast<int>(std::ceil(2 * half / cell));
  return {.corner = Eigen::Vector2d::Constant(-side * cell / 2), .cell = cell, .side = side};
}

namespace {

/// The ground around the heap, cell by cell.
struct AroundHeap {
  std::vector<Eigen::Vector3d> places;  ///< in the file's coordinates
  std::vector<int> sector;
};

AroundHeap ground_around(const Survey& survey) {
  constexpr double kClear = 0.1;  // of the base's radius, between heap and ground
  const HeightMap& map = survey.heap.map;
  const double radius = survey.base_radius() / map.plan.cell;
  const int clear = std::max(2, static_cast<int>(std::lround(kClear * radius)));
  const auto near = dilated(map, survey.heap.base, clear);
  AroundHeap around;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (near[k] != 0 || map.kind[k] != CellKind::seen) continue;
    const Eigen::Vector2d place = map.middle(k);
    const Eigen::Vector2d out = place - survey.heap.axis;
    const double turn = std::atan2(out.y(), out.x()) / (2 * std::numbers::pi) + .5;
    around.places.push_back(survey.frame.outside({place.x(), place.y(), map.height[k]}));
    around.sector.push_back(std::min(kSectors - 1, static_cast<int>(turn * kSectors)));
  }
  return around;
}

/// Draws the map and finds the heap on it.
bool draw_map(const std::vector<Eigen::Vector3d>& points, const FoundHeap& found, Survey& survey) {
  constexpr double kAboveNoise = 4, kAbove = 0.03, kBelowNoise = 8, kBelow = 0.1;
  constexpr std::size_t kFewestInBody = 50;
  survey.frame = ScanFrame(survey.plane, found.middle);
  const double lowest = -std::max(kBelowNoise * survey.plane.noise, kBelow * found.radius);
  survey.heap.map = height_map(points, survey.frame, plan_around(found), lowest);
  double highest = survey.heap.height;
  if (highest <= 0) {
    const auto rough =
        regions_above(survey.heap.map, kAboveNoise * survey.plane.noise, kFewestInBody);
    if (rough.empty()) return false;
    highest = rough.front().highest;
  }
  survey.threshold = std::max(kAboveNoise * survey.plane.noise, kAbove * highest);
  const auto regions = regions_above(survey.heap.map, survey.threshold, kFewestInBody);
  if (regions.empty()) return false;
  survey.heap.base = mask_of(survey.heap.map, regions.front());
  survey.cut = regions.front().cut;
  set_crest_and_axis(survey.heap);
  return survey.heap.height > survey.threshold;
}

/// A scan's ground may be bent as a whole, in all sectors alike: with a bowl or a dome z = a + c
/// r^2, fitted to its visible part around the heap, the ground below the heap's axis differs from
/// the plane by c mean(r^2), and the heap would be bent with it, by c R^2 / 2 on average over its
/// base of radius R.
void find_bow(const std::vector<Eigen::Vector3d>& places, double tolerance, Survey& survey) {
  std::vector<Eigen::Vector3d> ground;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) {
    if (std::abs(survey.plane.height(place)) < tolerance) ground.push_back(place);
  }
  if (ground.empty()) return;
  for (const Eigen::Vector3d& place : ground) middle += place / static_cast<double>(ground.size());
  const auto n = static_cast<double>(ground.size());
  double r2 = 0, z = 0, r4 = 0, r2z = 0;
  for (const Eigen::Vector3d& place : ground) {
    const double height = survey.plane.height(place);
    const double square = (place - middle).squaredNorm() - height * height;
    r2 += square / n, z += height / n, r4 += square * square / n, r2z += square * height / n;
  }
  const double spread = r4 - r2 * r2;
  if (!(spread > 0)) return;
  survey.bow = (r2z - r2 * z) / spread;
  survey.sunk = std::abs(survey.bow) * (r2 + std::pow(survey.base_radius(), 2) / 2);
}

}  // namespace

bool survey_heap(const std::vector<Eigen::Vector3d>& points, const FoundHeap& found, bool is_told,
                 Survey& survey) {
  constexpr int kRounds = 2;
  constexpr double kNearGround = 0.05;  // of the heap's height, as a minimum
  constexpr double kWithinNoise = 4;
  for (int round = 0; round < kRounds; ++round) {
    if (!draw_map(points, found, survey)) return false;
    const AroundHeap around = ground_around(survey);
    const double tolerance =
        std::max(kWithinNoise * survey.plane.noise, kNearGround * survey.heap.height);
    const GroundPlane local = refined(survey.plane, around.places, tolerance);
    survey.plane.noise = local.noise;
    if (!is_told) survey.plane = local;
  }
  if (!draw_map(points, found, survey)) return false;
  const AroundHeap around = ground_around(survey);
  constexpr std::size_t kFewestInSector = 20;
  const double tolerance =
      std::max(kWithinNoise * survey.plane.noise, kNearGround * survey.heap.height);
  std::array<std::vector<double>, kSectors> heights;
  for (std::size_t k = 0; k < around.places.size(); ++k) {
    const double height = survey.plane.height(around.places[k]);
    if (std::abs(height) < tolerance) {
      heights[static_cast<std::size_t>(around.sector[k])].push_back(height);
    }
  }
  find_bow(around.places, tolerance, survey);
  for (const std::vector<double>& sector : heights) {
    if (sector.size() >= kFewestInSector) survey.levels.push_back(median(sector));
  }
  return true;
}

namespace {

constexpr double kRing = 1.0 / 30;  // of the base's radius

/// Heights at one distance from the axis.
struct Ring {
  double level = 0;   ///< median height; 0 if too little is seen
  double spread = 0;  ///< robust standard deviation
};

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Rings from the axis to the map's edge, without its corners.
std::vector<Ring> rings_around(const Survey& survey) {
  constexpr std::size_t kFewest = 24;  // cells
  constexpr double kSdPerMad = 1.4826;
  const HeightMap& map = survey.heap.map;
  const double width = kRing * survey.base_radius();
  const double farthest = map.plan.cell * map.side() / 2;
  std::vector<std::vector<double>> heights(static_cast<std::size_t>(farthest / width));
  for (std::size_t k = 0; k < map.height.size(); ++k) {
    if (map.kind[k] != CellKind::seen) continue;
    const auto ring = static_cast<std::size_t>((map.middle(k) - survey.heap.axis).norm() / width);
    if (ring < heights.size()) heights[ring].push_back(map.height[k]);
  }
  std::vector<Ring> rings;
  for (std::vector<double>& ring : heights) {
    rings.emplace_back();
    if (ring.size() < kFewest) continue;
    rings.back().level = median_of(ring);
    for (double& height : ring) height = std::abs(height - rings.back().level);
    rings.back().spread = kSdPerMad * median_of(ring);
  }
  return rings;
}

}  // namespace

std::optional<double> ledge_around(const Survey& survey) {
  constexpr double kLowest = 0.02, kHighest = 0.5;  // of the heap's height
  constexpr double kSteepest = 0.05, kEven = 0.15, kFallen = 0.4;
  constexpr std::size_t kLevelRings = 2, kStepRings = 3;
  const double noise = 3 * survey.plane.noise;
  const double rise = kSteepest * kRing * survey.base_radius() + survey.plane.noise;
  const std::vector<Ring> rings = rings_around(survey);
  std::size_t run = 0;  // number of consecutive ledge rings up to this one
  for (std::size_t k = 1; k + kStepRings < rings.size(); ++k) {
    const auto& [level, spread] = rings[k];
    const double height = std::abs(level);
    const bool is_ledge = height > std::max(noise, kLowest * survey.heap.height) &&
                          height < kHighest * survey.heap.height &&
                          spread < kEven * height + survey.plane.noise &&
                          std::abs(level - rings[k - 1].level) < rise;
    run = is_ledge ? run + 1 : 0;
    const double beyond = std::abs(rings[k + kStepRings].level);
    if (run >= kLevelRings && beyond < kFallen * height) return level;
  }
  return std::nullopt;
}

}  // namespace repose::vision
