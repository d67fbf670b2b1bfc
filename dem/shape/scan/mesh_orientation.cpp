#include "dem/shape/scan/mesh_orientation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dem/shape/scan/mesh_edges.h"

namespace repose::dem {
namespace {

constexpr int kNone = -1;

struct Neighbour {
  int triangle = kNone;
  bool agrees = true;  ///< runs along the common edge the other way
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

/// Walks one piece from `seed`. A triangle's `turned` is 1 when it disagrees with the seed.
/// @return the piece's triangles; `is_two_sided` becomes false where the walk contradicts itself.
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

}  // namespace repose::dem
