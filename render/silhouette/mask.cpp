#include "render/silhouette/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "render/gl/lens.h"

namespace repose::render {

namespace {

/// Calls `use(y, first, end)` for each row of pixels whose centres lie in a disc.
template <class Use>
void for_rows(const PictureSize& size, const vision::Point& middle, double radius_px, Use use) {
  const auto clipped = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int bottom = clipped(std::ceil(middle.y + radius_px), size.height);
  for (int y = clipped(std::floor(middle.y - radius_px), size.height); y < bottom; ++y) {
    const double dy = y + .5 - middle.y;
    const double half2 = radius_px * radius_px - dy * dy;
    if (half2 <= 0) continue;
    const double half = std::sqrt(half2);
    const int first = clipped(std::ceil(middle.x - half - .5), size.width);
    const int end = clipped(std::floor(middle.x + half - .5) + 1, size.width);
    if (first < end) use(y, first, end);
  }
}

}  // namespace

void cover_disc(std::vector<std::uint8_t>& mask, const PictureSize& size,
                const vision::Point& middle, double radius_px) {
  for_rows(size, middle, radius_px, [&](int y, int first, int end) {
    const auto row = mask.begin() + std::ptrdiff_t{y} * size.width;
    std::fill(row + first, row + end, std::uint8_t{255});
  });
}

CoveredArea::CoveredArea(const std::vector<std::uint8_t>& mask, const PictureSize& size)
    : size_(size), before_(at(size.height + 1, 0)) {
  auto pixel = mask.begin();
  for (int y = 0; y < size.height; ++y) {
    std::uint32_t in_row = 0;
    for (int x = 0; x < size.width; ++x, ++pixel) {
      in_row += *pixel != 0 ? 1U : 0U;
      before(y + 1, x + 1) = before(y, x + 1) + in_row;
    }
  }
}

bool CoveredArea::hides_box(const PixelBox& box) const {
  const int first_x = std::max(box.first_x, 0), end_x = std::min(box.end_x, size_.width);
  const int first_y = std::max(box.first_y, 0), end_y = std::min(box.end_y, size_.height);
  if (first_x >= end_x || first_y >= end_y) return true;
  const std::uint32_t covered = before(end_y, end_x) - before(first_y, end_x) -
                                before(end_y, first_x) + before(first_y, first_x);
  return covered ==
         static_cast<std::uint32_t>(end_x - first_x) * static_cast<std::uint32_t>(end_y - first_y);
}

bool CoveredArea::hides_disc(const vision::Point& middle, double radius_px) const {
  bool is_hidden = true;
  for_rows(size_, middle, radius_px, [&](int y, int first, int end) {
    is_hidden = is_hidden && hides_box({first, end, y, y + 1});
  });
  return is_hidden;
}

namespace {

const char* const kVertex = R"(
in vec3 position;
in vec4 row_x, row_y, row_z;
void main() {
  vec4 p = vec4(position, 1.0);
  gl_Position = in_picture(vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p)));
}
)";

const char* const kFragment = R"(#version 330 core
uniform float value;
out vec4 colour;
void main() { colour = vec4(value); }
)";

}  // namespace

MaskPainter::MaskPainter(const gl::Functions& gl)
    : gl_(gl), program_(gl, lens_source() + kVertex, kFragment, kAttributes) {}

template <class Draw>
std::vector<std::uint8_t> MaskPainter::paint(const View& view, const Stage& stage, bool has_depth,
                                             Draw draw) {
  const auto [width, height] = view.size;
  const gl::Texture colour(gl_, gl::PixelFormat::grey8, width, height);
  const auto depth = has_depth
                         ? std::make_unique<gl::Texture>(gl_, gl::PixelFormat::depth, width, height)
                         : nullptr;
  const gl::Target target(gl_, &colour, depth.get());
  target.use();
  gl_.Disable(GL_BLEND);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | (has_depth ? GL_DEPTH_BUFFER_BIT : 0U));
  (has_depth ? gl_.Enable : gl_.Disable)(GL_DEPTH_TEST);
  program_.use();
  set_lens(program_, view, stage, 1);
  program_.set("value", 1.0);
  draw();
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, mask.data());
  return mask;
}

std::vector<std::uint8_t> MaskPainter::paint(const View& view, const Stage& stage) {
  return paint(view, stage, true, [&] {
    draw_batches(gl_, stage.grains);
    program_.set("value", 0.0);
    draw_batches(gl_, stage.walls);
  });
}

std::vector<std::uint8_t> MaskPainter::paint_grains(const View& view, const Stage& stage) {
  return paint(view, stage, false, [&] { draw_batches(gl_, stage.grains); });
}

std::vector<std::uint8_t> MaskPainter::paint_uncovered(const View& view, const Stage& stage,
                                                       const CoveredArea& covered) {
  return paint(view, stage, false, [&] { draw_uncovered(gl_, view, stage, covered); });
}

namespace {

/// Bound on the error of drawn vertices, pixels: drivers round to sixteenths or finer.
constexpr double kRounding_px = .1;

/// Triangles picked from all grains; each vertex also carries its grain's instance data.
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

  /// Limits memory: a million grains would need gigabytes.
  bool is_full() const {
    constexpr std::size_t kMostFloats = std::size_t{1} << 24;
    return vertices_.size() > kMostFloats;
  }

  /// Draws what was added, then clears it.
  void draw(const gl::Functions& gl) {
    if (corners_.empty()) return;
    std::vector<int> parts = kVertexParts;
    parts.insert(parts.end(), kInstanceParts.begin(), kInstanceParts.end());
    gl::Shape(gl, vertices_, corners_, parts).draw();
    vertices_.clear();
    corners_.clear();
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

  /// All pixels whose centres a triangle may cover.
  PixelBox box_of(std::span<const std::uint32_t> triangle) const {
    const auto clipped = [](double value) {
      constexpr double kMax = 1 << 20;  // wider than any picture
      return static_cast<int>(std::clamp(value, 0.0, kMax));
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
  std::vector<std::uint32_t> numbers_;  ///< their indices among all vertices, or kNone
  std::vector<float> vertices_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

void draw_uncovered(const gl::Functions& gl, const View& view, const Stage& stage,
                    const CoveredArea& covered) {
  Picked picked(view, stage, covered);
  set_culling(gl, true);
  for (const Batch& batch : stage.grains) {
    const std::span<const float> instances = batch.instances;
    for (std::size_t at = 0; at < instances.size(); at += kInstanceFloats) {
      picked.add(*batch.surface, instances.subspan(at, kInstanceFloats));
      if (picked.is_full()) picked.draw(gl);
    }
  }
  picked.draw(gl);
}

}  // namespace repose::render
