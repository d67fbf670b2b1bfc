#include "dem/shape/scan/hole_filling.h"

#include <algorithm>
#include <map>

#include "dem/shape/scan/mesh_edges.h"
#include "dem/shape/scan/mesh_measure.h"

namespace repose::dem {
namespace {

using NextCorners = std::map<int, std::vector<int>>;

/// Where the rims lead from each corner: against the direction of the triangle that is there.
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
      // A rim that meets itself in one corner is cut there into rims of their own.
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

}  // namespace repose::dem
