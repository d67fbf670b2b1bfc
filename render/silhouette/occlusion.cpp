#include "render/silhouette/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dem/shape/scan/triangle_tree.h"

namespace repose::render {
namespace {

using dem::Vector;

/// Bound on the error of drawn edges, pixels.
constexpr double kSafety_px = 1;

/// Winding number of the surface about the origin: 1 inside. Source: Van Oosterom & Strackee, The
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
  constexpr double kSlack = .01;  // open surfaces can have any winding number
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
  std::vector<double> cores_px, reaches_px;
  for (const dem::ClumpShape& shape : scene.shapes) {
    cores_px.push_back(view.scale * core_radius_m(shape, shown) - kSafety_px);
    reaches_px.push_back(view.scale * reach_m(shape) + kSafety_px);
  }
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(view.size.width) *
                                 static_cast<std::size_t>(view.size.height));
  for (const PlacedGrain& grain : scene.grains) {
    const double core_px = cores_px[static_cast<std::size_t>(grain.shape)];
    if (core_px <= 0) continue;
    cover_disc(mask, view.size, *view.project(grain.pose.position), core_px);
  }
  CoveredArea covered(mask, view.size);
  std::vector<PlacedGrain> visible;
  for (const PlacedGrain& grain : scene.grains) {
    const double reach_px = reaches_px[static_cast<std::size_t>(grain.shape)];
    if (!covered.hides_disc(*view.project(grain.pose.position), reach_px)) {
      visible.push_back(grain);
    }
  }
  return {std::move(mask), std::move(covered), std::move(visible)};
}

}  // namespace repose::render
