#include "render/upper_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "render/surface.h"

namespace repose::render {
namespace {

using dem::Vector;
using vision::Point;

/// Spheres are drawn as polyhedra this close, pixels.
constexpr double kSphereTolerance_px = 0.01;

/// The lowest y (uppermost point) in the middle of each column.
class Columns {
 public:
  explicit Columns(int width)
      : top_(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity()) {}

  void add_edge(Point from, Point to) {
    if (to.x < from.x) std::swap(from, to);
    const double last = static_cast<double>(top_.size()) - 1;
    const double first_column = std::max(0.0, std::ceil(from.x - .5));
    const double last_column = std::min(last, std::floor(to.x - .5));
    for (double column = first_column; column <= last_column; ++column) {
      const double part = to.x > from.x ? (column + .5 - from.x) / (to.x - from.x) : 0;
      double& top = top_[static_cast<std::size_t>(column)];
      top = std::min(top, from.y + part * (to.y - from.y));
    }
  }

  std::vector<Point> points() const {
    std::vector<Point> points;
    for (std::size_t k = 0; k < top_.size(); ++k) {
      if (std::isfinite(top_[k])) points.push_back({static_cast<double>(k) + .5, top_[k]});
    }
    return points;
  }

 private:
  std::vector<double> top_;
};

void add_mesh(Columns& columns, const View& view, const PlacedGrain& grain, const dem::Mesh& mesh) {
  std::vector<std::optional<Point>> places;
  places.reserve(mesh.vertices.size());
  for (const Vector& vertex : mesh.vertices) {
    places.push_back(view.project(grain.pose.position + grain.pose.orientation * vertex));
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& from = places[static_cast<std::size_t>(triangle[k])];
      const auto& to = places[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      // Every edge belongs to two triangles: one of them is enough.
      if (triangle[k] < triangle[(k + 1) % 3] && from && to) columns.add_edge(*from, *to);
    }
  }
}

dem::Mesh mesh_of(const Surface& surface) {
  dem::Mesh mesh;
  constexpr std::size_t kFloats = 6;
  for (std::size_t k = 0; k + kFloats <= surface.vertices.size(); k += kFloats) {
    mesh.vertices.emplace_back(surface.vertices[k], surface.vertices[k + 1],
                               surface.vertices[k + 2]);
  }
  for (std::size_t k = 0; k + 3 <= surface.corners.size(); k += 3) {
    mesh.triangles.push_back({static_cast<int>(surface.corners[k]),
                              static_cast<int>(surface.corners[k + 1]),
                              static_cast<int>(surface.corners[k + 2])});
  }
  return mesh;
}

}  // namespace

std::vector<Point> upper_edge(const Scene& scene, const View& view, Shown shown) {
  Columns columns(view.size.width);
  std::map<int, dem::Mesh> spheres;  // by shape
  for (const PlacedGrain& grain : scene.grains) {
    const dem::ClumpShape& shape = scene.shapes[static_cast<std::size_t>(grain.shape)];
    const bool has_mesh = !shape.surface.triangles.empty();
    if (has_mesh && shown != Shown::spheres) add_mesh(columns, view, grain, shape.surface);
    if (has_mesh && shown == Shown::mesh) continue;
    const auto [found, is_new] = spheres.try_emplace(grain.shape);
    if (is_new) {
      const double depth = std::max(view.in_camera(grain.pose.position).z(), 1e-9);
      found->second = mesh_of(
          sphere_surface(shape.spheres, 1e-3 * kSphereTolerance_px * view.mm_per_px(depth)));
    }
    add_mesh(columns, view, grain, found->second);
  }
  return columns.points();
}

}  // namespace repose::render
