#include "render/silhouette/uncovered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "render/gl/lens.h"

namespace repose::render {
namespace {

/// Drawn corners may be off by less than this, pixels: drivers round to sixteenths at least.
constexpr double kRounding_px = .1;

/// Triangles of all grains, each vertex with its grain's instance beside it.
class Picked {
 public:
  Picked(const View& view, const Stage& stage, const CoveredArea& covered)
      : to_px_(view.scale * view.axes.topRows<2>()),
        origin_px_(Eigen::Vector2d(view.middle.x, view.middle.y) +
                   to_px_ * (stage.origin - view.eye)),
        covered_(covered) {}

  void add(const Surface& surface, std::span<const float> instance) {
    project(surface, instance);
    numbers_.assign(xs_.size(), kNone);
    for (std::size_t k = 0; k + 3 <= surface.corners.size(); k += 3) {
      const auto triangle = std::span(surface.corners).subspan(k, 3);
      if (covered_.hides_box(box_of(triangle))) continue;
      for (const std::uint32_t corner : triangle) add_corner(surface, instance, corner);
    }
  }

  void draw(const gl::Functions& gl) const {
    if (corners_.empty()) return;
    std::vector<int> parts = kVertexParts;
    parts.insert(parts.end(), kInstanceParts.begin(), kInstanceParts.end());
    gl::Shape(gl, vertices_, corners_, parts).draw();
  }

 private:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

  void project(const Surface& surface, std::span<const float> instance) {
    using RowMajor = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;
    const Eigen::Matrix<double, 3, 4> pose =
        Eigen::Map<const RowMajor>(instance.data()).cast<double>();
    const Eigen::Matrix<double, 2, 3> turn = to_px_ * pose.leftCols<3>();
    const Eigen::Vector2d place = origin_px_ + to_px_ * pose.col(3);
    const std::size_t count = surface.vertices.size() / Surface::kFloats;
    xs_.resize(count);
    ys_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const float* at = &surface.vertices[Surface::kFloats * k];
      xs_[k] = place.x() + turn(0, 0) * at[0] + turn(0, 1) * at[1] + turn(0, 2) * at[2];
      ys_[k] = place.y() + turn(1, 0) * at[0] + turn(1, 1) * at[1] + turn(1, 2) * at[2];
    }
  }

  /// All pixels whose middles a triangle may blacken.
  PixelBox box_of(std::span<const std::uint32_t> triangle) const {
    const auto clipped = [](double value) {
      constexpr double kMost = 1 << 20;  // wider than any picture
      return static_cast<int>(std::clamp(value, 0.0, kMost));
    };
    const auto first = [&](double low) { return clipped(std::ceil(low - .5 - kRounding_px)); };
    const auto end = [&](double high) { return clipped(std::floor(high + .5 + kRounding_px)); };
    const auto [a, b, c] = std::array{triangle[0], triangle[1], triangle[2]};
    return {.first_x = first(std::min({xs_[a], xs_[b], xs_[c]})),
            .end_x = end(std::max({xs_[a], xs_[b], xs_[c]})),
            .first_y = first(std::min({ys_[a], ys_[b], ys_[c]})),
            .end_y = end(std::max({ys_[a], ys_[b], ys_[c]}))};
  }

  void add_corner(const Surface& surface, std::span<const float> instance, std::uint32_t corner) {
    std::uint32_t& number = numbers_[corner];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(vertices_.size() / (Surface::kFloats + kInstanceFloats));
      const auto vertex =
          std::span(surface.vertices).subspan(Surface::kFloats * corner, Surface::kFloats);
      vertices_.insert(vertices_.end(), vertex.begin(), vertex.end());
      vertices_.insert(vertices_.end(), instance.begin(), instance.end());
    }
    corners_.push_back(number);
  }

  Eigen::Matrix<double, 2, 3> to_px_;
  Eigen::Vector2d origin_px_;
  const CoveredArea& covered_;
  std::vector<double> xs_, ys_;         ///< of the surface's vertices, pixels
  std::vector<std::uint32_t> numbers_;  ///< theirs among all vertices, or kNone
  std::vector<float> vertices_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

void draw_uncovered(const gl::Functions& gl, const View& view, const Stage& stage,
                    const CoveredArea& covered) {
  Picked picked(view, stage, covered);
  for (const Batch& batch : stage.grains) {
    const std::span<const float> instances = batch.instances;
    for (std::size_t at = 0; at < instances.size(); at += kInstanceFloats) {
      picked.add(*batch.surface, instances.subspan(at, kInstanceFloats));
    }
  }
  set_culling(gl, true);
  picked.draw(gl);
}

}  // namespace repose::render
