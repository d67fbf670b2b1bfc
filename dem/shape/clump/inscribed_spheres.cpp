#include "dem/shape/clump/inscribed_spheres.h"

#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>

#include "dem/shape/clump/columns.h"
#include "dem/shape/clump/surface_distance.h"
#include "dem/shape/scan/mesh_measure.h"

namespace repose::dem {
namespace {

constexpr int kGridAcross = 36;

/// How many of the points not covered yet a sphere would cover.
std::size_t gain(const ClumpSphere& sphere, const std::vector<Vector>& points,
                 const std::vector<bool>& covered) {
  std::size_t gained = 0;
  const double square = sphere.radius * sphere.radius;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!covered[i] && (points[i] - sphere.centre).squaredNorm() <= square) ++gained;
  }
  return gained;
}

void cover(const ClumpSphere& sphere, const std::vector<Vector>& points,
           std::vector<bool>& covered) {
  const double square = sphere.radius * sphere.radius;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - sphere.centre).squaredNorm() <= square) covered[i] = true;
  }
}

/// A candidate with the most that it may gain; `round` says how old that knowledge is.
struct Promise {
  double gain = 0;
  std::size_t candidate = 0;
  int round = -1;

  bool operator<(const Promise& other) const {
    return std::tie(gain, other.candidate) < std::tie(other.gain, candidate);
  }
};

}  // namespace

std::vector<ClumpSphere> inscribed_spheres(const Mesh& mesh, int count) {
  const Eigen::AlignedBox3d bounds = bounds_of(mesh);
  const ColumnGrid grid(bounds, kGridAcross);
  const std::vector<Vector> points = grid.points_inside(grid.of_surface(mesh));
  const SurfaceDistance surface(mesh);

  std::vector<ClumpSphere> candidates;
  std::priority_queue<Promise> promises;
  const double cell = std::pow(grid.spacing_m(), 3);
  for (const Vector& point : points) {
    const double radius = -surface.signed_distance(point);
    if (radius <= 0) continue;
    promises.push({4.0 / 3 * std::numbers::pi * std::pow(radius, 3) / cell + 1, candidates.size()});
    candidates.push_back({point, radius});
  }

  std::vector<bool> covered(points.size(), false);
  std::vector<ClumpSphere> chosen;
  while (static_cast<int>(chosen.size()) < count && !promises.empty()) {
    Promise best = promises.top();
    promises.pop();
    const ClumpSphere& sphere = candidates[best.candidate];
    const auto round = static_cast<int>(chosen.size());
    if (best.round == round) {
      chosen.push_back(sphere);
      cover(sphere, points, covered);
      continue;
    }
    // Gains only shrink as spheres are added: an old one is still the most it can be.
    best.gain = static_cast<double>(gain(sphere, points, covered));
    best.round = round;
    if (best.gain > 0) promises.push(best);
  }
  return chosen;
}

}  // namespace repose::dem
