#include "vision/scan/slices.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "base/units.h"
#include "vision/measure/definitions.h"
#include "vision/measure/profile.h"

namespace repose::vision {

namespace {

constexpr double kStep_rad = 2 * std::numbers::pi / kAzimuths;
constexpr double kSteepestSlice_rad = 70 * kDegree;  // no loose grains stand steeper
constexpr double kMostUnseen = 0.3;                  // of the window's length in a slice

Eigen::Vector2d place_at(const StandingScan& heap, double azimuth_rad, double radius) {
  return heap.axis + radius * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
}

/// The heap's surface from the axis outwards, in cells.
struct HalfProfile {
  std::vector<double> height;
  bool leaves_scan = false;
  double unseen = 0;  ///< fraction of the window's points that are in holes
};

/// Samples along one half-plane, in steps of a cell from the axis.
struct Ray {
  std::vector<double> height;      ///< in cells; NaN if nothing is seen
  std::vector<std::uint8_t> kind;  ///< 1: on the base, 2: in a hole of it, 0: beyond
};

constexpr int kRaysPerStep = 3;
constexpr int kRays = kRaysPerStep * kAzimuths;
constexpr int kRaysBeside = 9;  // on either side of a slice: a sector of 30 degrees

std::vector<Ray> rays_of(const StandingScan& heap) {
  const double cell = heap.map.plan.cell;
  const auto steps = static_cast<int>(heap.map.side() / std::numbers::sqrt2);
  std::vector<Ray> rays(kRays);
  for (int k = 0; k < kRays; ++k) {
    Ray& ray = rays[static_cast<std::size_t>(k)];
    for (int step = 0; step < steps; ++step) {
      const Eigen::Vector2d place = place_at(heap, k * kStep_rad / kRaysPerStep, step * cell);
      const std::size_t at = heap.map.cell_of(place);
      if (at == heap.map.height.size()) break;
      ray.height.push_back(heap.map.height_at(place) / cell);
      const bool is_hole = heap.map.kind[at] == CellKind::hole;
      ray.kind.push_back(heap.base[at] == 0 ? 0 : is_hole ? 2 : 1);
    }
  }
  return rays;
}

/// Mean of the rays of a sector, as far as half of them are seen and on the base.
HalfProfile half_profile(const std::vector<Ray>& rays, int middle, double crest,
                         const ScanOptions& options) {
  constexpr std::size_t kNear = 3;  // cells: the axis may be next to the body's only tip
  constexpr int kInSector = 2 * kRaysBeside + 1;
  HalfProfile profile;
  int in_window = 0, in_holes = 0;
  for (std::size_t step = 0;; ++step) {
    double sum = 0;
    int seen = 0, on_base = 0, holes = 0;
    for (int k = middle - kRaysBeside; k <= middle + kRaysBeside; ++k) {
      const Ray& ray = rays[static_cast<std::size_t>((k + kRays) % kRays)];
      if (step >= ray.height.size() || std::isnan(ray.height[step])) continue;
      ++seen;
      sum += ray.height[step];
      on_base += ray.kind[step] != 0 ? 1 : 0;
      holes += ray.kind[step] == 2 ? 1 : 0;
    }
    if (2 * seen < kInSector) {
      profile.leaves_scan = true;
      break;
    }
    const double height = sum / seen;
    profile.height.push_back(height);
    if (2 * on_base < seen && step >= kNear) break;
    if (height < options.window_from * crest || height > options.window_to * crest) continue;
    in_window += seen;
    in_holes += holes;
  }
  profile.unseen = in_window > 0 ? static_cast<double>(in_holes) / in_window : 0;
  return profile;
}

/// Joins two opposite half-planes to one profile, the first on the left.
Profile joined(const HalfProfile& left, const HalfProfile& right, double crest_height) {
  Profile profile;
  const auto reach = static_cast<int>(left.height.size());
  for (int k = reach - 1; k > 0; --k) {
    profile.along.push_back(-k);
    profile.height.push_back(left.height[static_cast<std::size_t>(k)]);
  }
  profile.crest = profile.along.size();
  for (std::size_t k = 0; k < right.height.size(); ++k) {
    profile.along.push_back(static_cast<double>(k));
    profile.height.push_back(right.height[k]);
  }
  profile.crest_height = crest_height;
  profile.leaves_frame_left = left.leaves_scan;
  profile.leaves_frame_right = right.leaves_scan;
  return profile;
}

Slice slice_of(double azimuth_rad, const HalfProfile& profile, FlankFit fit) {
  Slice slice{.azimuth = {.azimuth_rad = azimuth_rad,
                          .status = fit.status,
                          .reason = fit.reason,
                          .angle_rad = {}},
              .fit = std::move(fit),
              .reach = static_cast<double>(profile.height.size())};
  if (slice.azimuth.status == FlankStatus::truncated) {
    slice.azimuth.reason = "the scan's edge cuts the flank off";
  } else if (slice.azimuth.status == FlankStatus::ok && profile.unseen > kMostUnseen) {
    slice.azimuth.status = FlankStatus::absent;
    slice.azimuth.reason = "too much of the flank is a hole in the scan";
  }
  const bool is_slope = slice.fit.angle_rad > 0 && slice.fit.angle_rad < kSteepestSlice_rad;
  if (slice.azimuth.status == FlankStatus::ok && !is_slope) {
    slice.azimuth.status = FlankStatus::absent;
    slice.azimuth.reason = "this side falls off vertically, or rises outwards";
  }
  if (slice.azimuth.status == FlankStatus::ok) slice.azimuth.angle_rad = slice.fit.angle_rad;
  return slice;
}

/// Means of the definitions available for at least half of the pairs of half-planes.
class DefinitionMeans {
 public:
  void add(const std::vector<NamedAngle>& definitions) {
    ++pairs_;
    for (const NamedAngle& definition : definitions) {
      if (sums_.find(definition.name) == sums_.end()) order_.push_back(definition);
      auto& [sum, count] = sums_[definition.name];
      sum += definition.angle_rad;
      ++count;
    }
  }
  std::vector<NamedAngle> means() const {
    std::vector<NamedAngle> found;
    for (NamedAngle definition : order_) {
      const auto& [sum, count] = sums_.at(definition.name);
      if (2 * count < pairs_) continue;
      definition.angle_rad = sum / count;
      found.push_back(std::move(definition));
    }
    return found;
  }

 private:
  int pairs_ = 0;
  std::vector<NamedAngle> order_;
  std::map<std::string, std::pair<double, int>> sums_;
};

}  // namespace

namespace {

/// The height above which the heap is seen all around: 20 % of it, or more if the scan's edge cuts
/// it off.
double lowest_whole_level(const StandingScan& heap) {
  constexpr double kLow = 0.2, kHighest = 0.7;
  double low = kLow * heap.height;
  const int side = heap.map.side();
  for (int y = 1; y + 1 < side; ++y) {
    for (int x = 1; x + 1 < side; ++x) {
      const std::size_t cell = heap.map.at(x, y);
      if (heap.base[cell] == 0 || std::isnan(heap.map.height[cell])) continue;
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        if (heap.map.kind[heap.map.at(x + dx, y + dy)] != CellKind::outside) continue;
        low = std::max(low, static_cast<double>(heap.map.height[cell]));
      }
    }
  }
  return std::min(low, kHighest * heap.height);
}

}  // namespace

void set_crest_and_axis(StandingScan& heap) {
  constexpr double kHigh = 0.8;
  constexpr double kOfBase = 1.0 / 60;  // like the light smoothing of a picture's edge (descent_of)
  const auto cells =
      static_cast<double>(std::count(heap.base.begin(), heap.base.end(), std::uint8_t{1}));
  const double across = 2 * std::sqrt(cells / std::numbers::pi);
  const int reach = std::max(1, static_cast<int>(std::lround(across * kOfBase / 2)));
  const std::vector<float> smooth = smoothed(heap.map, reach);
  heap.height = 0;
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    if (heap.base[k] != 0 && !std::isnan(smooth[k])) {
      heap.height = std::max(heap.height, static_cast<double>(smooth[k]));
    }
  }
  const double low = lowest_whole_level(heap);
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double sum = 0;
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    if (heap.base[k] == 0 || std::isnan(smooth[k])) continue;
    const double part = std::clamp(static_cast<double>(smooth[k]), low, kHigh * heap.height) - low;
    moment += part * heap.map.middle(k);
    sum += part;
  }
  if (sum > 0) heap.axis = moment / sum;
}

StandingScan lifted(const StandingScan& heap, double rise) {
  StandingScan moved = heap;
  for (float& height : moved.map.height) height += static_cast<float>(rise);
  moved.height += rise;
  return moved;
}

std::vector<double> Slices::angles() const {
  std::vector<double> found;
  for (const Slice& slice : all) {
    if (slice.azimuth.angle_rad) found.push_back(*slice.azimuth.angle_rad);
  }
  return found;
}

std::optional<double> Slices::mean() const {
  const std::vector<double> found = angles();
  if (found.empty()) return std::nullopt;
  double sum = 0;
  for (const double angle : found) sum += angle;
  return sum / static_cast<double>(found.size());
}

Slices slices_of(const StandingScan& heap, const ScanOptions& options, bool has_definitions) {
  FlankOptions flank;
  flank.window_from = options.window_from;
  flank.window_to = options.window_to;
  const double crest = heap.height / heap.map.plan.cell;
  const std::vector<Ray> rays = rays_of(heap);
  Slices slices;
  DefinitionMeans definitions;
  slices.all.resize(kAzimuths);
  for (int k = 0; k < kAzimuths / 2; ++k) {
    const double right_rad = k * kStep_rad, left_rad = right_rad + std::numbers::pi;
    const HalfProfile right = half_profile(rays, k * kRaysPerStep, crest, options);
    const HalfProfile left = half_profile(rays, (k + kAzimuths / 2) * kRaysPerStep, crest, options);
    FlankFit left_fit, right_fit;
    const bool has_axis = !left.height.empty() && !right.height.empty();
    const Profile profile = has_axis ? joined(left, right, crest) : Profile{};
    if (has_axis) {
      left_fit = fit_flank(profile, Side::left, flank);
      right_fit = fit_flank(profile, Side::right, flank);
    } else {
      left_fit.reason = right_fit.reason = "the scan does not show the heap's axis";
    }
    if (has_definitions && has_axis) {
      const FittedEdge edge{.profile = profile, .left = left_fit, .right = right_fit, .grain = {}};
      definitions.add(other_definitions(edge));
    }
    const auto place = static_cast<std::size_t>(k);
    slices.all[place] = slice_of(right_rad, right, std::move(right_fit));
    slices.all[place + kAzimuths / 2] = slice_of(left_rad, left, std::move(left_fit));
  }
  slices.definitions = definitions.means();
  return slices;
}

std::vector<Point> mean_profile(const StandingScan& heap) {
  std::vector<Point> profile;
  const double cell = heap.map.plan.cell;
  for (int k = 0;; ++k) {
    double sum = 0;
    int seen = 0, on_heap = 0;
    for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
      const Eigen::Vector2d place = place_at(heap, azimuth * kStep_rad, k * cell);
      const double height = heap.map.height_at(place);
      if (std::isnan(height)) continue;
      ++seen;
      sum += height;
      on_heap += heap.base[heap.map.cell_of(place)] != 0 ? 1 : 0;
    }
    if (2 * on_heap < kAzimuths) return profile;
    profile.push_back({k * cell, sum / seen});
  }
}

}  // namespace repose::vision
