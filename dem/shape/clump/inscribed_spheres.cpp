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

/// Points that no sphere covers yet, by coordinate: each round of the cover reads all of them for
/// many candidates.
class OpenPoints {
 public:
  explicit OpenPoints(const std::vector<Vector>& points) {
    for (const Vector& point : points) {
      x_.push_back(point.x());
      y_.push_back(point.y());
      z_.push_back(point.z());
    }
  }

  std::size_t inside(const ClumpSphere& sphere) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) count += contains(sphere, i) ? 1 : 0;
    return count;
  }

  void take_inside(const ClumpSphere& sphere) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (contains(sphere, i)) continue;
      x_[left] = x_[i];
      y_[left] = y_[i];
      z_[left++] = z_[i];
    }
    for (std::vector<double>* coordinate : {&x_, &y_, &z_}) coordinate->resize(left);
  }

 private:
  bool contains(const ClumpSphere& sphere, std::size_t i) const {
    const double x = x_[i] - sphere.centre.x(), y = y_[i] - sphere.centre.y(),
                 z = z_[i] - sphere.centre.z();
    return x * x + (y * y + z * z) <= sphere.radius * sphere.radius;
  }

  std::vector<double> x_, y_, z_;
};

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

  OpenPoints open(points);
  std::vector<ClumpSphere> chosen;
  while (static_cast<int>(chosen.size()) < count && !promises.empty()) {
    Promise best = promises.top();
    promises.pop();
    const ClumpSphere& sphere = candidates[best.candidate];
    const auto round = static_cast<int>(chosen.size());
    if (best.round == round) {
      chosen.push_back(sphere);
      open.take_inside(sphere);
      continue;
    }
    // Gains only shrink as spheres are added: an old one is still the most it can be.
    best.gain = static_cast<double>(open.inside(sphere));
    best.round = round;
    if (best.gain > 0) promises.push(best);
  }
  return chosen;
}

}  // namespace repose::dem
