#include "dem/shape/scan/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/triangle_tree.h"

namespace repose::dem {

namespace {

using NextCorners = std::map<int, std::vector<int>>;

/// Next rim corners from each corner: against the direction of the adjoining triangle.
NextCorners rim_edges(const Mesh& mesh) {
  NextCorners next;
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    const EdgeUse& use = edge.front();
    if (use.is_upward) {
      next[use.high].push_back(use.low);
    } else {
      next[use.low].push_back(use.high);
    }
  });
  return next;
}

Hole measured_hole(const Mesh& mesh, std::vector<int> rim) {
  Hole hole{.rim = std::move(rim)};
  for (const int i : hole.rim) hole.middle += mesh.vertices[static_cast<std::size_t>(i)];
  hole.middle /= static_cast<double>(hole.rim.size());
  for (std::size_t i = 0; i < hole.rim.size(); ++i) {
    const Vector& from = mesh.vertices[static_cast<std::size_t>(hole.rim[i])];
    const Vector& to = mesh.vertices[static_cast<std::size_t>(hole.rim[(i + 1) % hole.rim.size()])];
    hole.area += (from - hole.middle).cross(to - hole.middle).norm() / 2;
  }
  return hole;
}

}  // namespace

std::vector<Hole> find_holes(const Mesh& mesh) {
  NextCorners next = rim_edges(mesh);
  std::vector<Hole> holes;
  for (auto& [start, ways] : next) {
    while (!ways.empty()) {
      // A rim that meets itself at a corner is split there into separate rims.
      std::vector<int> walk = {start};
      while (!walk.empty()) {
        std::vector<int>& onwards = next[walk.back()];
        if (onwards.empty()) break;  // an open end: the surface is not consistently oriented
        const int corner = onwards.back();
        onwards.pop_back();
        const auto earlier = std::find(walk.begin(), walk.end(), corner);
        if (earlier == walk.end()) {
          walk.push_back(corner);
          continue;
        }
        holes.push_back(measured_hole(mesh, {earlier, walk.end()}));
        walk.erase(earlier + 1, walk.end());
        if (walk.size() == 1) break;
      }
    }
  }
  return holes;
}

void fill_hole(const Hole& hole, Mesh& mesh) {
  if (hole.rim.size() == 3) {
    mesh.triangles.push_back({hole.rim[0], hole.rim[1], hole.rim[2]});
    return;
  }
  const auto middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(hole.middle);
  for (std::size_t i = 0; i < hole.rim.size(); ++i) {
    mesh.triangles.push_back({middle, hole.rim[i], hole.rim[(i + 1) % hole.rim.size()]});
  }
}

namespace {

constexpr int kNone = -1;

struct Neighbour {
  int triangle = kNone;
  bool agrees = true;  ///< traverses the common edge in the opposite direction
};

using FacetNeighbours = std::vector<std::array<Neighbour, 3>>;

FacetNeighbours neighbours_of(const Mesh& mesh) {
  FacetNeighbours neighbours(mesh.triangles.size());
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].is_upward != edge[1].is_upward;
    const auto side_of = [&](const EdgeUse& use) -> Neighbour& {
      return neighbours[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)];
    };
    side_of(edge[0]) = {edge[1].triangle, agrees};
    side_of(edge[1]) = {edge[0].triangle, agrees};
  });
  return neighbours;
}

/// Walks one piece from `seed`. A triangle's `turned` is 1 if it disagrees with the seed.
/// @return the piece's triangles; `is_two_sided` becomes false if the walk contradicts itself.
std::vector<int> walk_piece(const FacetNeighbours& neighbours, int seed, std::vector<int>& turned,
                            bool& is_two_sided) {
  std::vector<int> piece = {seed};
  turned[static_cast<std::size_t>(seed)] = 0;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const auto here = static_cast<std::size_t>(piece[next]);
    for (const Neighbour& neighbour : neighbours[here]) {
      if (neighbour.triangle == kNone) continue;
      int& other = turned[static_cast<std::size_t>(neighbour.triangle)];
      const int expected = neighbour.agrees ? turned[here] : 1 - turned[here];
      if (other == kNone) {
        other = expected;
        piece.push_back(neighbour.triangle);
      } else if (other != expected) {
        is_two_sided = false;
      }
    }
  }
  return piece;
}

}  // namespace

Oriented orient_consistently(Mesh& mesh) {
  Oriented result;
  const FacetNeighbours neighbours = neighbours_of(mesh);
  std::vector<int> turned(mesh.triangles.size(), kNone);
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (turned[seed] != kNone) continue;
    const std::vector<int> piece =
        walk_piece(neighbours, static_cast<int>(seed), turned, result.is_two_sided);
    const auto disagree =
        static_cast<std::size_t>(std::count_if(piece.begin(), piece.end(), [&](int t) {
          return turned[static_cast<std::size_t>(t)] == 1;
        }));
    const int minority = 2 * disagree > piece.size() ? 0 : 1;
    for (const int t : piece) {
      if (turned[static_cast<std::size_t>(t)] != minority) continue;
      std::array<int, 3>& triangle = mesh.triangles[static_cast<std::size_t>(t)];
      std::swap(triangle[1], triangle[2]);
      ++result.turned;
    }
  }
  return result;
}

std::vector<int> pieces_of(const Mesh& mesh) {
  const FacetNeighbours neighbours = neighbours_of(mesh);
  std::vector<int> piece_of(mesh.triangles.size(), kNone);
  std::vector<int> turned(mesh.triangles.size(), kNone);
  bool is_two_sided = true;
  int pieces = 0;
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (piece_of[seed] != kNone) continue;
    for (const int t : walk_piece(neighbours, static_cast<int>(seed), turned, is_two_sided)) {
      piece_of[static_cast<std::size_t>(t)] = pieces;
    }
    ++pieces;
  }
  return piece_of;
}

namespace {

constexpr double kTouchFraction = 1e-7;

using Triangle = std::array<Vector, 3>;

/// Whether the segment p-q passes through the triangle, by more than `touch` on both sides.
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

/// Whether any side of `of` passes through `other`, without sides that share a corner with it.
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

namespace {

/// Finds the first corner within a distance of a point.
class CornerFinder {
 public:
  CornerFinder(const Vector& origin, double distance) : origin_(origin), distance_(distance) {}

  /// The corner near `point`; added if there is none.
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
