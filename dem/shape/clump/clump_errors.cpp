#include "dem/shape/clump/clump_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dem/shape/clump/surface.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

namespace {

bool touch(const ClumpSphere& a, const ClumpSphere& b) {
  constexpr double kRounding = 1e-9;
  return (a.centre - b.centre).norm() <= (a.radius + b.radius) * (1 + kRounding);
}

}  // namespace

int sphere_groups(const std::vector<ClumpSphere>& spheres) {
  std::vector<bool> is_reached(spheres.size(), false);
  std::vector<std::size_t> open;
  int groups = 0;
  for (std::size_t start = 0; start < spheres.size(); ++start) {
    if (is_reached[start]) continue;
    ++groups;
    is_reached[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t from = open.back();
      open.pop_back();
      for (std::size_t k = start + 1; k < spheres.size(); ++k) {
        if (is_reached[k] || !touch(spheres[from], spheres[k])) continue;
        is_reached[k] = true;
        open.push_back(k);
      }
    }
  }
  return groups;
}

namespace {

constexpr int kColumnsAcross = 256;
constexpr std::size_t kSamples = 20000;
constexpr double kPercentile = 0.95;

/// Distances, each with the fraction of both surfaces that it represents.
using Distances = std::vector<std::pair<double, double>>;

/// Distance of a point from the union's surface, negative inside. Exact outside. Inside, the
/// distance to the nearest surface point that is not inside another sphere.
double union_distance(const Vector& point, const std::vector<ClumpSphere>& spheres,
                      const std::vector<WeightedPoint>& outside) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double distance = (point - spheres[i].centre).norm() - spheres[i].radius;
    if (distance < nearest) {
      nearest = distance;
      deepest = i;
    }
  }
  if (nearest >= 0) return nearest;
  const ClumpSphere& sphere = spheres[deepest];
  const Vector way = point - sphere.centre;
  const Vector straight = sphere.centre + sphere.radius * way.stableNormalized();
  const bool is_hidden = std::any_of(spheres.begin(), spheres.end(), [&](const ClumpSphere& other) {
    return &other != &sphere && (straight - other.centre).norm() < other.radius;
  });
  if (!is_hidden) return nearest;
  double square = std::numeric_limits<double>::infinity();
  for (const WeightedPoint& seen : outside) {
    square = std::min(square, (seen.point - point).squaredNorm());
  }
  return -std::sqrt(square);
}

double inertia_error(const MassProperties& body, const MassProperties& spheres) {
  const Vector apart = spheres.centroid - body.centroid;
  const Eigen::Matrix3d of_body = body.volume_m3 * gyration_of(body.second_moment_m2);
  const Eigen::Matrix3d of_spheres =
      spheres.volume_m3 * gyration_of(spheres.second_moment_m2 + apart * apart.transpose());
  return (of_spheres - of_body).norm() / of_body.norm();
}

/// Weighted percentile.
double percentile(Distances distances, double fraction) {
  std::sort(distances.begin(), distances.end());
  double passed = 0;
  for (const auto& [distance, weight] : distances) {
    passed += weight;
    if (passed >= fraction) return distance;
  }
  return distances.empty() ? 0 : distances.back().first;
}

void compare_surfaces(const Mesh& mesh, const std::vector<ClumpSphere>& spheres,
                      ClumpErrors& errors) {
  const std::vector<WeightedPoint> of_union = sample_union(spheres, kSamples);
  const std::vector<SurfaceSample> of_mesh = sample_surface(mesh, kSamples);
  Distances distances;
  for (const SurfaceSample& sample : of_mesh) {
    const double distance = union_distance(sample.point, spheres, of_union);
    errors.falls_short_m = std::max(errors.falls_short_m, distance);
    distances.emplace_back(std::abs(distance), 0.5 / static_cast<double>(of_mesh.size()));
  }
  double area = 0;
  for (const WeightedPoint& point : of_union) area += point.area;
  const SurfaceDistance surface(mesh);
  for (const WeightedPoint& point : of_union) {
    const double distance = surface.signed_distance(point.point);
    errors.sticks_out_m = std::max(errors.sticks_out_m, distance);
    distances.emplace_back(std::abs(distance), 0.5 * point.area / area);
  }
  for (const auto& [distance, weight] : distances) {
    errors.surface_error_mean_m += weight * distance;
  }
  errors.surface_error_p95_m = percentile(std::move(distances), kPercentile);
}

}  // namespace

ClumpErrors clump_errors(const Mesh& mesh, const std::vector<ClumpSphere>& spheres) {
  Eigen::AlignedBox3d bounds = bounds_of(mesh);
  for (const ClumpSphere& sphere : spheres) {
    bounds.extend(Vector(sphere.centre + Vector::Constant(sphere.radius)));
    bounds.extend(Vector(sphere.centre - Vector::Constant(sphere.radius)));
  }
  const ColumnGrid grid(bounds, kColumnsAcross);
  const std::vector<Chords> of_spheres = grid.of_union(spheres);
  const std::vector<Chords> of_mesh = grid.of_surface(mesh);
  const MassProperties body = mass_properties(mesh);
  const MassProperties clump = grid.mass_properties(of_spheres);

  ClumpErrors errors;
  errors.volume_error = grid.mismatch_m3(of_mesh, of_spheres) / body.volume_m3;
  errors.volume_difference = (clump.volume_m3 - body.volume_m3) / body.volume_m3;
  errors.inertia_error = inertia_error(body, clump);
  compare_surfaces(mesh, spheres, errors);
  return errors;
}

}  // namespace repose::dem
