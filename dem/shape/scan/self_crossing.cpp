#include "dem/shape/scan/self_crossing.h"

#include <algorithm>
#include <array>
#include <vector>

#include "dem/shape/scan/mesh_measure.h"
#include "dem/shape/scan/triangle_tree.h"

namespace repose::dem {
namespace {

constexpr double kTouchFraction = 1e-7;

using Triangle = std::array<Vector, 3>;

/// Whether the segment p-q goes through the triangle, by more than `touch` on both sides.
bool pierces(const Vector& p, const Vector& q, const Triangle& triangle, double touch) {
  const Vector normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double length = normal.norm();
  if (length <= touch * touch) return false;
  const double height_p = normal.dot(p - triangle[0]) / length;
  const double height_q = normal.dot(q - triangle[0]) / length;
  const bool is_across =
      (height_p > touch && height_q < -touch) || (height_p < -touch && height_q > touch);
  if (!is_across) return false;
  const Vector crossing = p + height_p / (height_p - height_q) * (q - p);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector side = triangle[(i + 1) % 3] - triangle[i];
    if (normal.cross(side).dot(crossing - triangle[i]) < 0) return false;
  }
  return true;
}

Triangle places(const Mesh& mesh, const std::array<int, 3>& triangle) {
  return {corner(mesh, triangle, 0), corner(mesh, triangle, 1), corner(mesh, triangle, 2)};
}

/// Sides of `of` that could pass through `other`: not those that start at a common corner.
bool any_side_pierces(const Mesh& mesh, const std::array<int, 3>& of,
                      const std::array<int, 3>& other, double touch) {
  const auto is_common = [&](int index) {
    return std::find(other.begin(), other.end(), index) != other.end();
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (is_common(of[i]) || is_common(of[next])) continue;
    if (pierces(corner(mesh, of, i), corner(mesh, of, next), places(mesh, other), touch)) {
      return true;
    }
  }
  return false;
}

}  // namespace

SelfCrossing find_self_crossing(const Mesh& mesh) {
  SelfCrossing result;
  const TriangleTree tree(mesh);
  const double touch = kTouchFraction * bounds_of(mesh).diagonal().norm();
  std::vector<bool> crosses(mesh.triangles.size(), false);
  std::vector<int> near;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    near.clear();
    tree.append_touching(bounds_of(mesh, triangle), near);
    for (const int n : near) {
      const auto index = static_cast<std::size_t>(n);
      if (index <= t) continue;
      const auto& other = mesh.triangles[index];
      if (any_side_pierces(mesh, triangle, other, touch) ||
          any_side_pierces(mesh, other, triangle, touch)) {
        crosses[t] = crosses[index] = true;
      }
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!crosses[t]) continue;
    if (result.triangles++ == 0) result.where = bounds_of(mesh, mesh.triangles[t]).center();
  }
  return result;
}

}  // namespace repose::dem
