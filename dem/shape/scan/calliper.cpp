#include "dem/shape/scan/calliper.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

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
    // Even steps in angle: close together at the ends, where the surface bends most.
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

std::vector<std::string> CalliperSizes::problems() const {
  std::vector<std::string> problems;
  const auto check_size = [&](const char* name, double size_m) {
    if (size_m >= kSmallestGrain_m && size_m <= kLargestGrain_m) return;
    std::ostringstream problem;
    problem << "size: the " << name << " is " << 1e3 * size_m << " mm, and grains are from "
            << 1e3 * kSmallestGrain_m << " to " << 1e3 * kLargestGrain_m
            << " mm. Fix: give length, width and thickness in mm.";
    problems.push_back(problem.str());
  };
  check_size("length", length_m);
  check_size("width", width_m);
  check_size("thickness", thickness_m);
  if (!(tip_fraction >= 0 && tip_fraction <= 1)) {
    std::ostringstream problem;
    problem << "tip: is " << tip_fraction
            << ", and must be from 0 (round) to 1 (pointed). Fix: a hazelnut is about 0.5.";
    problems.push_back(problem.str());
  }
  return problems;
}

Mesh calliper_surface(const CalliperSizes& sizes) {
  const std::vector<std::string> problems = sizes.problems();
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
  Mesh mesh;
  add_corners(sizes, mesh);
  add_triangles(mesh);
  return mesh;
}

}  // namespace repose::dem
