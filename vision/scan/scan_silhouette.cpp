#include "vision/scan/scan_silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/input_error.h"
#include "base/units.h"

namespace repose::vision {
namespace {

constexpr int kWidth_px = 960;
constexpr double kAside = 1.3;     // the picture's half width / the base's largest radius
constexpr double kHeadroom = 1.3;  // the picture's height above the ground / the heap's
constexpr int kBelowGround_px = 40;
constexpr std::array<std::array<int, 2>, 2> kNeighbours{{{1, 0}, {0, 1}}};

/// Highest points along the lines of sight, column by column, in pixels.
class Skyline {
 public:
  explicit Skyline(int columns) : highest_(static_cast<std::size_t>(columns), 0) {}

  /// Adds the edge between two places; heights below the ground hide nothing.
  void add(double along, double height, double other_along, double other_height) {
    if (along > other_along) {
      std::swap(along, other_along);
      std::swap(height, other_height);
    }
    const double length = other_along - along;
    const int last = static_cast<int>(std::floor(other_along - .5));
    for (int column = static_cast<int>(std::ceil(along - .5)); column <= last; ++column) {
      if (column < 0 || column >= static_cast<int>(highest_.size())) continue;
      const double part = length > 0 ? (column + .5 - along) / length : 0;
      double& kept = highest_[static_cast<std::size_t>(column)];
      kept = std::max(kept, height + part * (other_height - height));
    }
  }
  double operator[](int column) const { return highest_[static_cast<std::size_t>(column)]; }

 private:
  std::vector<double> highest_;
};

std::size_t cell_at(const ScanMap& map, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.side) +
         static_cast<std::size_t>(x);
}

bool is_heap(const ScanMap& map, int x, int y) {
  if (x >= map.side || y >= map.side) return false;
  const std::size_t cell = cell_at(map, x, y);
  return map.with_toe[cell] != 0 && std::isfinite(map.height[cell]);
}

}  // namespace

ScanSilhouettes::ScanSilhouettes(const ScannedHeap& heap) : map_(heap.map) {
  if (heap.angle.status == MeasureStatus::refused || map_.with_toe.empty()) {
    throw base::InputError({.value = heap.angle.reason});
  }
  double reach = 0, highest = 0;
  for (int y = 0; y < map_.side; ++y) {
    for (int x = 0; x < map_.side; ++x) {
      if (!is_heap(map_, x, y)) continue;
      reach = std::max(reach, std::hypot((x + .5) * map_.cell - map_.axis[0],
                                         (y + .5) * map_.cell - map_.axis[1]));
      highest = std::max(highest, static_cast<double>(map_.height[cell_at(map_, x, y)]));
    }
  }
  length_px_ = 2 * kAside * reach / kWidth_px;
  width_ = kWidth_px;
  height_ = static_cast<int>(std::ceil(kHeadroom * highest / length_px_)) + kBelowGround_px;
  if (heap.unit_mm) m_per_px_ = length_px_ * *heap.unit_mm * kMPerMm;
}

Picture ScanSilhouettes::seen_from(double azimuth_rad) const {
  Skyline skyline(width_);
  const double right_x = std::cos(azimuth_rad), right_y = std::sin(azimuth_rad);
  const auto along_px = [&](int x, int y) {
    const double along = ((x + .5) * map_.cell - map_.axis[0]) * right_x +
                         ((y + .5) * map_.cell - map_.axis[1]) * right_y;
    return .5 * width_ + along / length_px_;
  };
  const auto height_px = [&](int x, int y) {
    return map_.height[cell_at(map_, x, y)] / length_px_;
  };
  for (int y = 0; y < map_.side; ++y) {
    for (int x = 0; x < map_.side; ++x) {
      if (!is_heap(map_, x, y)) continue;
      for (const auto& [right, up] : kNeighbours) {
        if (!is_heap(map_, x + right, y + up)) continue;
        skyline.add(along_px(x, y), height_px(x, y), along_px(x + right, y + up),
                    height_px(x + right, y + up));
      }
    }
  }
  Picture picture;
  picture.width = width_;
  picture.height = height_;
  constexpr std::size_t kChannels = 3;
  const auto row_bytes = kChannels * static_cast<std::size_t>(width_);
  picture.bgr.assign(row_bytes * static_cast<std::size_t>(height_), std::uint8_t{255});
  const int ground_row = height_ - kBelowGround_px;
  for (int column = 0; column < width_; ++column) {
    const int top = ground_row - static_cast<int>(std::lround(skyline[column]));
    for (int row = std::max(0, top); row < ground_row; ++row) {
      const auto pixel = picture.bgr.begin() +
                         static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * row_bytes +
                                                     kChannels * static_cast<std::size_t>(column));
      std::fill(pixel, pixel + kChannels, std::uint8_t{0});
    }
  }
  return picture;
}

}  // namespace repose::vision
