#include "dem/shape/clump/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/shape/scan/mesh_measure.h"

namespace repose::dem {
namespace {

/// Point k of a sequence that fills the unit square evenly.
/// Source: Roberts, The unreasonable effectiveness of quasirandom sequences (2018): additive
/// recurrence with the powers of 1/p, p^3 = p + 1.
struct SquarePoint {
  double u, v;
};
SquarePoint square_point(std::size_t k) {
  constexpr double kPlastic = 1.324717957244746;
  const double n = static_cast<double>(k) + 1;
  const double u = 0.5 + n / kPlastic, v = 0.5 + n / (kPlastic * kPlastic);
  return {u - std::floor(u), v - std::floor(v)};
}

/// Point k of n spread evenly over the unit sphere, on a spiral.
/// Source: Swinbank & Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132 (2006) 1769-1793.
Vector sphere_point(std::size_t k, std::size_t n) {
  const double z = (2 * static_cast<double>(k) + 1) / static_cast<double>(n) - 1;
  const double angle = 2 * std::numbers::pi * static_cast<double>(k) * (1 - 1 / std::numbers::phi);
  const double across = std::sqrt((1 - z) * (1 + z));
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count) {
  const double step = area_m2(mesh) / static_cast<double>(count);
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  double passed = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vector normal = area_normal(mesh, triangle);
    passed += normal.norm() / 2;
    while (samples.size() < count && (static_cast<double>(samples.size()) + 0.5) * step <= passed) {
      const SquarePoint at = square_point(samples.size());
      const bool is_folded = at.u + at.v > 1;
      const double u = is_folded ? 1 - at.u : at.u, v = is_folded ? 1 - at.v : at.v;
      const Vector& a = corner(mesh, triangle, 0);
      samples.push_back(
          {.point = a + u * (corner(mesh, triangle, 1) - a) + v * (corner(mesh, triangle, 2) - a),
           .normal = normal.stableNormalized()});
    }
  }
  return samples;
}

std::vector<WeightedPoint> sample_union(std::span<const ClumpSphere> spheres, std::size_t count) {
  double squares = 0;
  for (const ClumpSphere& sphere : spheres) squares += sphere.radius * sphere.radius;
  std::vector<WeightedPoint> points;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const ClumpSphere& sphere = spheres[i];
    const double square = sphere.radius * sphere.radius;
    const auto own =
        static_cast<std::size_t>(std::ceil(static_cast<double>(count) * (square / squares)));
    for (std::size_t k = 0; k < own; ++k) {
      const Vector point = sphere.centre + sphere.radius * sphere_point(k, own);
      bool is_hidden = false;
      for (std::size_t j = 0; j < spheres.size() && !is_hidden; ++j) {
        is_hidden = j != i && (point - spheres[j].centre).squaredNorm() <
                                  spheres[j].radius * spheres[j].radius;
      }
      if (is_hidden) continue;
      points.push_back({point, 4 * std::numbers::pi * square / static_cast<double>(own)});
    }
  }
  return points;
}

}  // namespace repose::dem
