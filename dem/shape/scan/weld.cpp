#include "dem/shape/scan/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

#include "dem/shape/scan/mesh_measure.h"

namespace repose::dem {
namespace {

/// Finds the first corner within a distance of a point.
class CornerFinder {
 public:
  CornerFinder(const Vector& origin, double distance) : origin_(origin), distance_(distance) {}

  /// The corner near `point`, which is added when there is none.
  int corner_at(const Vector& point, std::vector<Vector>& corners) {
    const Cell cell = cell_of(point);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const int corner = corner_in({cell[0] + x, cell[1] + y, cell[2] + z}, point, corners);
          if (corner >= 0) return corner;
        }
      }
    }
    const auto added = static_cast<int>(corners.size());
    corners.push_back(point);
    cells_[cell].push_back(added);
    return added;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 0;
      for (const std::int64_t index : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15U;
        hash ^= hash >> 32U;
      }
      return hash;
    }
  };

  Cell cell_of(const Vector& point) const {
    const Vector scaled = (point - origin_) / distance_;
    return {std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())};
  }

  int corner_in(const Cell& cell, const Vector& point, const std::vector<Vector>& corners) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return -1;
    for (const int corner : found->second) {
      const Vector& place = corners[static_cast<std::size_t>(corner)];
      if ((place - point).squaredNorm() <= distance_ * distance_) return corner;
    }
    return -1;
  }

  Vector origin_;
  double distance_;
  std::unordered_map<Cell, std::vector<int>, Hash> cells_;
};

}  // namespace

Mesh without_loose_corners(const Mesh& mesh) {
  Mesh saved;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (std::array<int, 3> triangle : mesh.triangles) {
    for (int& corner : triangle) {
      int& renumbered = number[static_cast<std::size_t>(corner)];
      if (renumbered < 0) {
        renumbered = static_cast<int>(saved.vertices.size());
        saved.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = renumbered;
    }
    saved.triangles.push_back(triangle);
  }
  return saved;
}

Welded weld(const Mesh& mesh) {
  Welded result;
  if (mesh.vertices.empty()) return result;
  const Eigen::AlignedBox3d bounds = bounds_of(mesh);
  const double distance = kWeldFraction * bounds.diagonal().norm();
  std::vector<int> corner_of(mesh.vertices.size(), 0);
  Mesh joined;
  if (distance > 0) {
    CornerFinder finder(bounds.min(), distance);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      corner_of[i] = finder.corner_at(mesh.vertices[i], joined.vertices);
    }
  } else {
    joined.vertices = {mesh.vertices.front()};
  }
  std::set<std::array<int, 3>> seen;
  for (std::array<int, 3> triangle : mesh.triangles) {
    for (int& corner : triangle) corner = corner_of[static_cast<std::size_t>(corner)];
    const auto& [a, b, c] = triangle;
    if (a == b || b == c || c == a) {
      ++result.collapsed;
      continue;
    }
    std::array<int, 3> key = triangle;
    std::sort(key.begin(), key.end());
    if (seen.insert(key).second) {
      joined.triangles.push_back(triangle);
    } else {
      ++result.duplicates;
    }
  }
  result.mesh = without_loose_corners(joined);
  return result;
}

}  // namespace repose::dem
