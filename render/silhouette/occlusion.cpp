#include "render/silhouette/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/shape/scan/triangle_tree.h"

namespace repose::render {
namespace {

using dem::Vector;

/// Drawn edges may be off by less than this, pixels.
constexpr double kSafety_px = 1;

/// How often the surface winds round the origin: 1 inside. Source: Van Oosterom & Strackee, The
/// solid angle of a plane triangle, IEEE Trans. Biomed. Eng. BME-30 (1983) 125-126, eq. (8).
double winding(const dem::Mesh& mesh) {
  double solid_angle = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const auto at = [&mesh](int corner) -> const Vector& {
      return mesh.vertices[static_cast<std::size_t>(corner)];
    };
    const Vector &a = at(i), &b = at(j), &c = at(k);
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)),
                                  la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle / (4 * std::numbers::pi);
}

double mesh_core_m(const dem::Mesh& mesh) {
  constexpr double kSlack = .01;  // open surfaces wind round a point by any part of 1
  if (std::abs(winding(mesh) - 1) > kSlack) return 0;
  double nearest2 = std::numeric_limits<double>::max();
  for (const auto& [i, j, k] : mesh.triangles) {
    const auto at = [&mesh](int corner) -> const Vector& {
      return mesh.vertices[static_cast<std::size_t>(corner)];
    };
    const Vector point = dem::nearest_on_triangle(Vector::Zero(), at(i), at(j), at(k)).point;
    nearest2 = std::min(nearest2, point.squaredNorm());
  }
  return std::sqrt(nearest2);
}

/// Calls `use(y, first, end)` for each row of pixels whose middles lie in a disc.
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

void cover_disc(std::vector<std::uint8_t>& mask, const PictureSize& size,
                const vision::Point& middle, double radius_px) {
  for_rows(size, middle, radius_px, [&](int y, int first, int end) {
    const auto row = mask.begin() + std::ptrdiff_t{y} * size.width;
    std::fill(row + first, row + end, std::uint8_t{255});
  });
}

/// How many covered pixels of its row lie left of each corner between pixels.
class CoveredRows {
 public:
  CoveredRows(const std::vector<std::uint8_t>& mask, const PictureSize& size)
      : size_(size), left_(at(size.height, 0)) {
    std::size_t from = 0;
    for (int y = 0; y < size.height; ++y) {
      std::uint32_t in_row = 0;
      for (int x = 0; x < size.width; ++x, ++from) {
        in_row += mask[from] != 0 ? 1U : 0U;
        left_[at(y, x + 1)] = in_row;
      }
    }
  }

  bool hide_disc(const vision::Point& middle, double radius_px) const {
    bool are_covered = true;
    for_rows(size_, middle, radius_px, [&](int y, int first, int end) {
      const std::uint32_t covered = left_[at(y, end)] - left_[at(y, first)];
      are_covered = are_covered && covered == static_cast<std::uint32_t>(end - first);
    });
    return are_covered;
  }

 private:
  std::size_t at(int y, int x) const {
    return static_cast<std::size_t>(y) * (static_cast<std::size_t>(size_.width) + 1) +
           static_cast<std::size_t>(x);
  }

  PictureSize size_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

double core_radius_m(const dem::ClumpShape& shape, Shown shown) {
  if (!shape.surface.triangles.empty() && shown != Shown::spheres) {
    return mesh_core_m(shape.surface);
  }
  double radius = 0;
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    radius = std::max(radius, sphere.radius - sphere.centre.norm());
  }
  return radius;
}

Occlusion occluded_part(const Scene& scene, const View& view, Shown shown) {
  Occlusion occlusion;
  occlusion.mask.resize(static_cast<std::size_t>(view.size.width) *
                        static_cast<std::size_t>(view.size.height));
  if (view.is_perspective) {
    occlusion.visible = scene.grains;
    return occlusion;
  }
  std::vector<double> cores_px, reaches_px;
  for (const dem::ClumpShape& shape : scene.shapes) {
    cores_px.push_back(view.scale * core_radius_m(shape, shown) - kSafety_px);
    reaches_px.push_back(view.scale * reach_m(shape) + kSafety_px);
  }
  for (const PlacedGrain& grain : scene.grains) {
    const double core_px = cores_px[static_cast<std::size_t>(grain.shape)];
    if (core_px <= 0) continue;
    cover_disc(occlusion.mask, view.size, *view.project(grain.pose.position), core_px);
  }
  const CoveredRows rows(occlusion.mask, view.size);
  for (const PlacedGrain& grain : scene.grains) {
    const double reach_px = reaches_px[static_cast<std::size_t>(grain.shape)];
    if (!rows.hide_disc(*view.project(grain.pose.position), reach_px)) {
      occlusion.visible.push_back(grain);
    }
  }
  return occlusion;
}

}  // namespace repose::render
