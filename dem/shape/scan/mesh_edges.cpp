#include "dem/shape/scan/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace repose::dem {

std::vector<EdgeUse> edge_uses(const Mesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const int from = mesh.triangles[t][side], to = mesh.triangles[t][(side + 1) % 3];
      uses.push_back({.low = std::min(from, to),
                      .high = std::max(from, to),
                      .triangle = static_cast<int>(t),
                      .side = static_cast<int>(side),
                      .is_upward = from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  });
  return uses;
}

bool is_watertight(const Mesh& mesh) {
  bool is_tight = !mesh.triangles.empty();
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].is_upward == edge[1].is_upward) is_tight = false;
  });
  return is_tight;
}

}  // namespace repose::dem
