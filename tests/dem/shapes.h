#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "dem/shape/scan/calliper.h"
#include "dem/shape/scan/mesh.h"

/// Surfaces with known properties.
namespace repose::testing {

/// The sample hazelnut, from its calliper sizes.
inline dem::Mesh nut_surface() {
  return dem::calliper_surface(
      {.length_m = 22.48e-3, .width_m = 18.23e-3, .thickness_m = 17.46e-3, .tip_fraction = 0.5});
}

/// A box centred on the origin, two triangles per face.
inline dem::Mesh box_surface(double x_m, double y_m, double z_m) {
  dem::Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(x_m * ((i & 1) - 0.5), y_m * ((i >> 1 & 1) - 0.5),
                               z_m * ((i >> 2 & 1) - 0.5));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Vertices at the origin and at one point along each axis.
inline dem::Mesh corner_tetrahedron(double x_m, double y_m, double z_m) {
  return {.vertices = {{0, 0, 0}, {x_m, 0, 0}, {0, y_m, 0}, {0, 0, z_m}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline dem::Mesh moved(dem::Mesh mesh, const dem::Quaternion& turn, const dem::Vector& shift_m) {
  for (dem::Vector& vertex : mesh.vertices) vertex = turn * vertex + shift_m;
  return mesh;
}

inline dem::Mesh inside_out(dem::Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// Both surfaces in one mesh.
inline dem::Mesh together(dem::Mesh a, const dem::Mesh& b) {
  const auto first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

/// Every triangle with its own vertices, as in STL.
inline dem::Mesh taken_apart(const dem::Mesh& mesh) {
  dem::Mesh apart;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<int>(apart.vertices.size());
    for (const int corner : triangle) {
      apart.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
    }
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

}  // namespace repose::testing
