#include "dem/wall/mesh_facets.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

Mesh with_shared_corners(const Mesh& mesh) {
  Mesh shared;
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> number_of;
  for (const Vector& vertex : mesh.vertices) {
    const auto [known, is_new] = numbers.try_emplace({vertex.x(), vertex.y(), vertex.z()},
                                                     static_cast<int>(shared.vertices.size()));
    if (is_new) shared.vertices.push_back(vertex);
    number_of.push_back(known->second);
  }
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = number_of.at(static_cast<std::size_t>(triangle[k]));
    }
    shared.triangles.push_back(corners);
  }
  return shared;
}

void check(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw base::InputError({.value = "a mesh wall has no triangles"});
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& [a, b, c] = mesh.triangles[k];
    const auto at = [&mesh](int corner) { return mesh.vertices[static_cast<std::size_t>(corner)]; };
    const Vector area = (at(b) - at(a)).cross(at(c) - at(a));
    if (!(area.norm() > 0)) {
      throw base::InputError({.value = fmt::format("a mesh wall's triangle {} has no area", k),
                              .fix = "remove degenerate triangles from the file."});
    }
  }
}

}  // namespace

MeshFacets::MeshFacets(const Mesh& mesh) : mesh_(with_shared_corners(mesh)), tree_(mesh_) {
  check(mesh_);
  corner_start_.assign(mesh_.vertices.size() + 1, 0);
  for (const auto& triangle : mesh_.triangles) {
    for (const int corner : triangle) ++corner_start_[static_cast<std::size_t>(corner) + 1];
  }
  for (std::size_t k = 1; k < corner_start_.size(); ++k) corner_start_[k] += corner_start_[k - 1];
  corner_triangles_.resize(3 * mesh_.triangles.size());
  std::vector<int> next(corner_start_.begin(), corner_start_.end() - 1);
  for (std::size_t k = 0; k < mesh_.triangles.size(); ++k) {
    for (const int corner : mesh_.triangles[k]) {
      const int at = next[static_cast<std::size_t>(corner)]++;
      corner_triangles_[static_cast<std::size_t>(at)] = static_cast<int>(k);
    }
  }
}

void MeshFacets::near(const Vector& point, double distance, std::vector<int>& facets) const {
  facets.clear();
  const Vector half = Vector::Constant(distance);
  tree_.append_touching(Bounds(point - half, point + half), facets);
  std::sort(facets.begin(), facets.end());
}

TrianglePoint MeshFacets::nearest(int facet, const Vector& point) const {
  const auto& [a, b, c] = mesh_.triangles[static_cast<std::size_t>(facet)];
  const auto at = [this](int corner) -> const Vector& {
    return mesh_.vertices[static_cast<std::size_t>(corner)];
  };
  return nearest_on_triangle(point, at(a), at(b), at(c));
}

Closest MeshFacets::closest(int facet, const Vector& point) const {
  const TrianglePoint spot = nearest(facet, point);
  const Vector away = point - spot.point;
  const double distance = away.norm();
  if (distance == 0 || !owns(facet, spot, point)) {
    return {.distance = kEndless, .normal = Vector::UnitZ()};
  }
  return {.distance = distance, .normal = away / distance};
}

bool MeshFacets::owns(int facet, const TrianglePoint& spot, const Vector& point) const {
  using Part = TrianglePoint::Part;
  if (spot.part == Part::face) return true;
  const auto& corners = mesh_.triangles[static_cast<std::size_t>(facet)];
  const int from = corners[static_cast<std::size_t>(spot.index)];
  const int to = corners[static_cast<std::size_t>((spot.index + 1) % 3)];
  const auto begin = static_cast<std::size_t>(corner_start_[static_cast<std::size_t>(from)]);
  const auto end = static_cast<std::size_t>(corner_start_[static_cast<std::size_t>(from) + 1]);
  for (std::size_t k = begin; k < end; ++k) {
    const int other = corner_triangles_[k];
    if (other == facet) continue;
    const auto& others = mesh_.triangles[static_cast<std::size_t>(other)];
    if (spot.part == Part::edge && std::find(others.begin(), others.end(), to) == others.end()) {
      continue;  // it shares a corner of the edge only
    }
    const TrianglePoint near = nearest(other, point);
    const double there = (point - near.point).squaredNorm();
    const double here = (point - spot.point).squaredNorm();
    // The shared edge is a part of `other`, so that it cannot be farther away but by rounding.
    const bool is_same_spot = near.part != Part::face && there >= here * (1 - 1e-12);
    if (!is_same_spot || other < facet) return false;
  }
  return true;
}

}  // namespace repose::dem
