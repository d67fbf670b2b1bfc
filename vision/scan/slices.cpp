#include "vision/scan/slices.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
constexpr double kMostUnseen = 0.3;  // of the window's length in a slice

Eigen::Vector2d place_at(const StandingScan& heap, double azimuth_rad, double radius) {
  return heap.axis + radius * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
}

/// The heap's surface from the axis outwards, in cells.
struct HalfProfile {
  std::vector<double> height;
  bool leaves_scan = false;
  double unseen = 0;  ///< which part of the window's points are in holes
};

/// Mean of three half-planes a third of a step apart; NaN where nothing is seen.
double height_near(const StandingScan& heap, double azimuth_rad, double radius) {
  double sum = 0;
  for (const int third : {-1, 0, 1}) {
    sum += heap.map.height_at(place_at(heap, azimuth_rad + third * kStep_rad / 3, radius));
  }
  return sum / 3;
}

HalfProfile half_profile(const StandingScan& heap, double azimuth_rad, const ScanOptions& options) {
  constexpr int kNear = 3;      // cells: the axis may stand beside the body's only tip
  constexpr int kCellsOff = 2;  // beyond the base: one is no end
  const double cell = heap.map.plan.cell;
  HalfProfile profile;
  int in_window = 0, in_holes = 0, off = 0;
  for (int k = 0; off < kCellsOff; ++k) {
    const double radius = k * cell;
    const double height = height_near(heap, azimuth_rad, radius);
    if (std::isnan(height)) {
      profile.leaves_scan = true;
      break;
    }
    const std::size_t at = heap.map.cell_of(place_at(heap, azimuth_rad, radius));
    off = heap.base[at] != 0 || k < kNear ? 0 : off + 1;
    profile.height.push_back(height / cell);
    if (height < options.window_from * heap.height || height > options.window_to * heap.height) {
      continue;
    }
    ++in_window;
    in_holes += heap.map.kind[at] == CellKind::hole ? 1 : 0;
  }
  profile.unseen = in_window > 0 ? static_cast<double>(in_holes) / in_window : 0;
  return profile;
}

/// Two opposite half-planes as one profile, the first to the left.
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
              .fit = std::move(fit)};
  if (slice.azimuth.status == FlankStatus::truncated) {
    slice.azimuth.reason = "the scan's edge cuts the flank off";
  } else if (slice.azimuth.status == FlankStatus::ok && profile.unseen > kMostUnseen) {
    slice.azimuth.status = FlankStatus::absent;
    slice.azimuth.reason = "too much of the flank is a hole in the scan";
  }
  if (slice.azimuth.status == FlankStatus::ok) slice.azimuth.angle_rad = slice.fit.angle_rad;
  return slice;
}

/// Means over what most pairs of half-planes have.
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

/// The height from which on the heap is seen all around: 20 % of it, or more where the scan's edge
/// cuts it off.
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
  constexpr double kOfBase = 1.0 / 60;  // as lightly as a picture's edge is (descent_of)
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
  Slices slices;
  DefinitionMeans definitions;
  slices.all.resize(kAzimuths);
  for (int k = 0; k < kAzimuths / 2; ++k) {
    const double right_rad = k * kStep_rad, left_rad = right_rad + std::numbers::pi;
    const HalfProfile right = half_profile(heap, right_rad, options);
    const HalfProfile left = half_profile(heap, left_rad, options);
    const Profile profile = joined(left, right, crest);
    FlankFit left_fit = fit_flank(profile, Side::left, flank);
    FlankFit right_fit = fit_flank(profile, Side::right, flank);
    if (has_definitions) {
      const FittedEdge edge{.profile = profile, .left = left_fit, .right = right_fit, .grain = {}};
      definitions.add(other_definitions(edge));
    }
    slices.all[static_cast<std::size_t>(k)] = slice_of(right_rad, right, std::move(right_fit));
    slices.all[static_cast<std::size_t>(k + kAzimuths / 2)] =
        slice_of(left_rad, left, std::move(left_fit));
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
