#include "render/scene/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include <meshoptimizer.h>

namespace repose::render {
namespace {

using dem::Vector;

void append(Surface& surface, const Vector& point, const Vector& normal) {
  for (const double value : point) surface.vertices.push_back(static_cast<float>(value));
  for (const double value : normal) surface.vertices.push_back(static_cast<float>(value));
}

/// Weighted by triangle area.
std::vector<Vector> smooth_normals(const dem::Mesh& mesh) {
  std::vector<Vector> normals(mesh.vertices.size(), Vector::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&mesh](int k) -> const Vector& {
      return mesh.vertices[static_cast<std::size_t>(k)];
    };
    const Vector normal = (at(b) - at(a)).cross(at(c) - at(a));
    for (const int k : {a, b, c}) normals[static_cast<std::size_t>(k)] += normal;
  }
  for (Vector& normal : normals) normal.stableNormalize();
  return normals;
}

/// Drops vertices that no triangle uses.
Surface compact(const Surface& surface) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> place(surface.vertices.size() / Surface::kFloats, kUnused);
  Surface compacted;
  for (const std::uint32_t corner : surface.corners) {
    if (place[corner] == kUnused) {
      place[corner] = static_cast<std::uint32_t>(compacted.vertices.size() / Surface::kFloats);
      const auto first =
          surface.vertices.begin() + static_cast<std::ptrdiff_t>(corner * Surface::kFloats);
      compacted.vertices.insert(compacted.vertices.end(), first,
                                first + static_cast<std::ptrdiff_t>(Surface::kFloats));
    }
    compacted.corners.push_back(place[corner]);
  }
  return compacted;
}

/// A unit sphere of triangles: an icosahedron with each edge halved `level` times.
dem::Mesh icosphere(int level) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  dem::Mesh mesh{.vertices = {{-1, g, 0},
                              {1, g, 0},
                              {-1, -g, 0},
                              {1, -g, 0},
                              {0, -1, g},
                              {0, 1, g},
                              {0, -1, -g},
                              {0, 1, -g},
                              {g, 0, -1},
                              {g, 0, 1},
                              {-g, 0, -1},
                              {-g, 0, 1}},
                 .triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                               {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                               {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                               {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  for (Vector& vertex : mesh.vertices) vertex.normalize();
  for (int k = 0; k < level; ++k) {
    std::map<std::pair<int, int>, int> halves;
    const auto half = [&mesh, &halves](int a, int b) {
      const auto [found, is_new] =
          halves.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (is_new) {
        const Vector middle =
            mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)];
        mesh.vertices.push_back(middle.normalized());
      }
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = half(a, b), bc = half(b, c), ca = half(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// Upper bound of how far the midpoints of an icosphere's longest edges lie inside the unit sphere.
/// The edges span 63.4 degrees at level 0, 36 at level 1 and about half as much at each further
/// level.
double sagitta(int level) {
  constexpr double kLongestEdge_rad = 1.32;  // 75.6 degrees
  return 1 - std::cos(.5 * kLongestEdge_rad / std::exp2(level));
}

/// Scale that gives a polyhedron in the unit sphere the sphere's surface area, and so its mean
/// shadow (see restore_area).
double growth_of(const dem::Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&mesh](int k) -> const Vector& {
      return mesh.vertices[static_cast<std::size_t>(k)];
    };
    area += .5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
  }
  return std::sqrt(4 * std::numbers::pi / area);
}

constexpr int kFinestSphere = 6;  ///< 81,920 triangles

int level_for(double radius_m, double tolerance_m) {
  int level = 1;
  // The polyhedron is enlarged by half the sagitta, so that the error is within +- half of it.
  while (level < kFinestSphere && .5 * radius_m * sagitta(level) > tolerance_m) ++level;
  return level;
}

bool is_inside(const dem::ClumpSphere& sphere, const Vector& point) {
  return (point - sphere.centre).squaredNorm() < sphere.radius * sphere.radius;
}

/// A sphere's triangles, except those inside another sphere: spheres are convex, so it suffices
/// that all three vertices are inside.
void append_sphere(Surface& surface, const std::vector<dem::ClumpSphere>& spheres, std::size_t own,
                   double tolerance_m) {
  const dem::ClumpSphere& sphere = spheres[own];
  const int level = level_for(sphere.radius, tolerance_m);
  const dem::Mesh mesh = icosphere(level);
  const double radius = sphere.radius * growth_of(mesh);
  const auto first = static_cast<std::uint32_t>(surface.vertices.size() / Surface::kFloats);
  for (const Vector& vertex : mesh.vertices) {
    append(surface, sphere.centre + radius * vertex, vertex);
  }
  // The other sphere's polyhedron must hide the triangle: its radius is reduced by the tolerance.
  const auto is_hidden = [&](const std::array<int, 3>& triangle) {
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      dem::ClumpSphere other = spheres[k];
      other.radius -= tolerance_m;
      if (k == own || other.radius <= 0) continue;
      const bool is_in = std::all_of(triangle.begin(), triangle.end(), [&](int corner) {
        return is_inside(other,
                         sphere.centre + radius * mesh.vertices[static_cast<std::size_t>(corner)]);
      });
      if (is_in) return true;
    }
    return false;
  };
  for (const auto& triangle : mesh.triangles) {
    if (is_hidden(triangle)) continue;
    for (const int corner : triangle) {
      surface.corners.push_back(first + static_cast<std::uint32_t>(corner));
    }
  }
}

/// A parallelogram divided into small ones; the cross product of `across` and `up` points outwards.
void append_sheet(Surface& surface, const Vector& corner, const Vector& across, const Vector& up,
                  double edge_m) {
  static constexpr double kMaxParts = 400;
  const auto parts = [edge_m](const Vector& side) {
    return static_cast<std::uint32_t>(std::clamp(std::ceil(side.norm() / edge_m), 1.0, kMaxParts));
  };
  const std::uint32_t columns = parts(across), rows = parts(up);
  const Vector normal = across.cross(up).normalized();
  const auto first = static_cast<std::uint32_t>(surface.vertices.size() / Surface::kFloats);
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      append(surface, corner + across * column / columns + up * row / rows, normal);
    }
  }
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = first + row * (columns + 1) + column, b = a + columns + 1;
      surface.corners.insert(surface.corners.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
}

void append_box(Surface& surface, const Vector& middle, const Vector& half, double edge_m) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Vector across = 2 * half[i] * Vector::Unit(i), up = 2 * half[j] * Vector::Unit(j);
    const Vector out = half[k] * Vector::Unit(k), corner = middle - .5 * across - .5 * up;
    append_sheet(surface, corner + out, across, up, edge_m);
    append_sheet(surface, corner - out, up, across, edge_m);
  }
}

void append_tube(Surface& surface, const dem::Tube& tube, double edge_m) {
  constexpr int kSides = 128;
  const double inner = tube.inner_radius, outer = inner + tube.thickness;
  const Vector up = tube.height * Vector::UnitZ();
  const auto way = [](int k) {
    const double turn = 2 * std::numbers::pi * k / kSides;
    return Vector(std::cos(turn), std::sin(turn), 0);
  };
  // Flat strips: each has the normal of its own plane.
  for (int k = 0; k < kSides; ++k) {
    const Vector from = way(k), to = way(k + 1);
    append_sheet(surface, outer * from, outer * (to - from), up, edge_m);
    append_sheet(surface, inner * to, inner * (from - to), up, edge_m);
    for (const auto& [height, a, b] :
         {std::tuple{tube.height, from, to}, std::tuple{0.0, to, from}}) {
      const auto first = static_cast<std::uint32_t>(surface.vertices.size() / Surface::kFloats);
      const Vector level = height * Vector::UnitZ();
      const Vector normal = height > 0 ? Vector::UnitZ() : Vector(-Vector::UnitZ());
      for (const Vector& corner :
           {Vector(inner * a), Vector(outer * a), Vector(outer * b), Vector(inner * b)}) {
        append(surface, level + corner, normal);
      }
      surface.corners.insert(surface.corners.end(),
                             {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
}

void append_flat(Surface& surface, const dem::Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    const auto at = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(triangle[k])];
    };
    const Vector normal = (at(1) - at(0)).cross(at(2) - at(0)).stableNormalized();
    for (std::size_t k = 0; k < 3; ++k) {
      surface.corners.push_back(
          static_cast<std::uint32_t>(surface.vertices.size() / Surface::kFloats));
      append(surface, at(k), normal);
    }
  }
}

/// The spheres of a bed within `half_m` of a place, at most as many as can be drawn.
void append_bed(Surface& surface, const dem::SphereBed& bed, const Vector& middle, double half_m) {
  constexpr double kMaxSpheres = 20000, kTolerance = .02;  // of the radius
  const double most =
      .5 * bed.tile * std::sqrt(kMaxSpheres / static_cast<double>(bed.spheres.size()));
  const double half = std::min(half_m, most);
  const auto from = [&](double place, double centre) {
    return std::ceil((place - half - centre) / bed.tile) * bed.tile + centre;
  };
  for (const dem::FixedSphere& sphere : bed.spheres) {
    const double from_x = from(middle.x(), sphere.centre.x());
    const double from_y = from(middle.y(), sphere.centre.y());
    for (double x = from_x; x <= middle.x() + half; x += bed.tile) {
      if (x < bed.from_x || x > bed.to_x) continue;
      for (double y = from_y; y <= middle.y() + half; y += bed.tile) {
        append_sphere(surface, {{.centre = {x, y, sphere.centre.z()}, .radius = sphere.radius}}, 0,
                      kTolerance * sphere.radius);
      }
    }
  }
}

/// Twice the total area of the triangles.
double area_of(const Surface& surface) {
  const auto at = [&surface](std::uint32_t corner) {
    const float* first = &surface.vertices[corner * Surface::kFloats];
    return Vector(first[0], first[1], first[2]);
  };
  double area = 0;
  for (std::size_t k = 0; k + 3 <= surface.corners.size(); k += 3) {
    const Vector a = at(surface.corners[k]);
    area += (at(surface.corners[k + 1]) - a).cross(at(surface.corners[k + 2]) - a).norm();
  }
  return area;
}

/// Round bodies shrink when vertices are removed. Scales the surface up to the area of the full
/// one: a convex body's silhouettes then have the same area too, averaged over all directions, and
/// edge errors go both ways. Source: Cauchy (1832), a convex body's mean shadow is a quarter of its
/// surface. Proved by Surface.FewerTrianglesKeepTheSilhouettesArea.
void restore_area(Surface& surface, double area) {
  const double now = area_of(surface);
  constexpr double kMax = 1.2;  // more means that the surface has collapsed
  if (!(now > 0) || !(area > now) || area > kMax * now) return;
  const auto growth = static_cast<float>(std::sqrt(area / now));
  for (std::size_t k = 0; k < surface.vertices.size(); k += Surface::kFloats) {
    for (std::size_t i = k; i < k + 3; ++i) surface.vertices[i] *= growth;
  }
}

}  // namespace

Surface grain_surface(const dem::Mesh& mesh, double tolerance_m) {
  Surface surface;
  const std::vector<Vector> normals = smooth_normals(mesh);
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    append(surface, mesh.vertices[k], normals[k]);
  }
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
  }
  constexpr std::size_t kStride = Surface::kFloats * sizeof(float);
  const std::size_t vertices = mesh.vertices.size();
  const float whole = meshopt_simplifyScale(surface.vertices.data(), vertices, kStride);
  surface.corners = corners;
  const double area = area_of(surface);
  const std::size_t saved = meshopt_simplify(surface.corners.data(), corners.data(), corners.size(),
                                             surface.vertices.data(), vertices, kStride, 0,
                                             static_cast<float>(tolerance_m) / whole);
  surface.corners.resize(saved);
  if (saved == 0) surface.corners = corners;  // a grain smaller than the tolerance has vanished
  restore_area(surface, area);
  return compact(surface);
}

Surface sphere_surface(const std::vector<dem::ClumpSphere>& spheres, double tolerance_m) {
  Surface surface;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    append_sphere(surface, spheres, k, tolerance_m);
  }
  return compact(surface);
}

Surface wall_surface(const dem::WallShape& shape, const Vector& slab_middle, double slab_half_m,
                     double edge_m) {
  Surface surface;
  if (const auto* box = std::get_if<dem::Box>(&shape)) {
    append_box(surface, Vector::Zero(), box->half_size, edge_m);
  } else if (const auto* tube = std::get_if<dem::Tube>(&shape)) {
    append_tube(surface, *tube, edge_m);
  } else if (const auto* mesh = std::get_if<dem::MeshSurface>(&shape)) {
    append_flat(surface, mesh->mesh);
  } else if (const auto* bed = std::get_if<dem::SphereBed>(&shape)) {
    append_bed(surface, *bed, slab_middle, slab_half_m);
  } else {
    constexpr double kThinness = 100;
    const double half_thickness = .5 * slab_half_m / kThinness;
    append_box(surface, {slab_middle.x(), slab_middle.y(), -half_thickness},
               {slab_half_m, slab_half_m, half_thickness}, edge_m);
  }
  return surface;
}

}  // namespace repose::render
