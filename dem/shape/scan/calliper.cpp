#include "dem/shape/scan/calliper.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dem/shape/scan/scan.h"

namespace repose::dem {
namespace {

constexpr int kRings = 63;       // odd: one of them is the widest
constexpr int kAroundRing = 96;  // a multiple of 4: corners in the extremes of y and z

/// Fraction of the full width at u from -1 to 1.
double fraction_of_width(double u, double tip_fraction) {
  return std::pow((1 - u) * (1 + u), u > 0 ? (1 + tip_fraction) / 2 : 0.5);
}

int ring_corner(int ring, int k) { return 1 + ring * kAroundRing + k % kAroundRing; }

void add_corners(const CalliperSizes& sizes, Mesh& mesh) {
  mesh.vertices.emplace_back(-sizes.length_m / 2, 0, 0);
  for (int ring = 0; ring < kRings; ++ring) {
    // Equal steps in angle: close together at the ends, where the curvature is greatest.
    const double u = -std::cos(std::numbers::pi * (ring + 1) / (kRings + 1));
    const double fraction = 2 * ring + 1 == kRings ? 1 : fraction_of_width(u, sizes.tip_fraction);
    for (int k = 0; k < kAroundRing; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAroundRing;
      mesh.vertices.emplace_back(sizes.length_m / 2 * u,
                                 sizes.width_m / 2 * fraction * std::cos(angle),
                                 sizes.thickness_m / 2 * fraction * std::sin(angle));
    }
  }
  mesh.vertices.emplace_back(sizes.length_m / 2, 0, 0);
}

void add_triangles(Mesh& mesh) {
  const auto last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int k = 0; k < kAroundRing; ++k) {
    mesh.triangles.push_back({0, ring_corner(0, k + 1), ring_corner(0, k)});
    mesh.triangles.push_back({last, ring_corner(kRings - 1, k), ring_corner(kRings - 1, k + 1)});
    for (int ring = 0; ring + 1 < kRings; ++ring) {
      const int a = ring_corner(ring, k), b = ring_corner(ring, k + 1);
      const int c = ring_corner(ring + 1, k), d = ring_corner(ring + 1, k + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  }
}

}  // namespace

std::vector<base::Fault> CalliperSizes::problems() const {
  std::vector<base::Fault> problems;
  const auto check_size = [&](const char* name, double size_m) {
    if (size_m >= kSmallestGrain_m && size_m <= kLargestGrain_m) return;
    problems.push_back(
        {.where = "size",
         .value = fmt::format("the {} is {:g} mm, and grains are from {:g} to {:g} mm", name,
                              1e3 * size_m, 1e3 * kSmallestGrain_m, 1e3 * kLargestGrain_m),
         .fix = "give length, width and thickness in mm."});
  };
  check_size("length", length_m);
  check_size("width", width_m);
  check_size("thickness", thickness_m);
  if (!(tip_fraction >= 0 && tip_fraction <= 1)) {
    problems.push_back({.where = "tip",
                        .value = fmt::format("is {:g}, and", tip_fraction),
                        .rule = "must be from 0 (round) to 1 (pointed)",
                        .fix = "a hazelnut is about 0.5."});
  }
  return problems;
}

Mesh calliper_surface(const CalliperSizes& sizes) {
  std::vector<base::Fault> problems = sizes.problems();
  if (!problems.empty()) throw base::InputError(std::move(problems));
  Mesh mesh;
  add_corners(sizes, mesh);
  add_triangles(mesh);
  return mesh;
}

}  // namespace repose::dem
