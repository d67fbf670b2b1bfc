#include "dem/shape/clump/relocation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace repose::dem {
namespace {

constexpr int kFirstIterations = 200;
constexpr int kTrialIterations = 15;
constexpr int kFinalIterations = 50;
constexpr double kPromising = 1.02;  // of the best cost, after the first iterations of a trial
constexpr double kWorthwhile = 1 - 5e-3;
constexpr std::size_t kSpared = 4;  // spheres that are tried elsewhere
constexpr std::size_t kSites = 6;   // places that are tried

int attempts_for(std::size_t spheres) {
  constexpr std::size_t kWork = 5000, kFewest = 30, kMost = 200;
  return static_cast<int>(std::clamp(kWork / spheres, kFewest, kMost));
}

/// The largest ball inside that touches the surface at sample `at`, as far as the samples tell.
///
///     r = min over the samples q of |p - q|^2 / (2 n.(p - q))
///
/// Source: Ma, Bae & Choi, 3D medial axis point approximation using nearest neighbors and the
/// normal field, Vis. Comput. 28 (2012) 7-19. Samples closer than `grain` say more of the noise
/// than of the shape and are left out.
ClumpSphere touching_ball(const std::vector<SurfaceSample>& samples, std::size_t at, double grain) {
  const SurfaceSample& touch = samples[at];
  double radius = std::numeric_limits<double>::infinity();
  for (const SurfaceSample& other : samples) {
    const Vector apart = touch.point - other.point;
    const double square = apart.squaredNorm(), depth = apart.dot(touch.normal);
    if (square < grain * grain || depth <= 0) continue;
    radius = std::min(radius, square / (2 * depth));
  }
  return {touch.point - radius * touch.normal, radius};
}

/// Indices by ascending value; equal ones in their order.
template <typename Value>
std::vector<std::size_t> ascending(std::size_t count, Value value) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
  return order;
}

/// Spheres by how little the cost would grow without them.
std::vector<std::size_t> by_use(const SphereFit::Reading& reading, std::size_t count) {
  std::vector<double> loss(count, 0);
  for (Eigen::Index i = 0; i < reading.sphere.size(); ++i) {
    const auto sphere = static_cast<std::size_t>(reading.sphere[i]);
    const double with = reading.error[i], without = reading.second_error[i];
    loss[sphere] += without * without - with * with;
  }
  return ascending(count, [&](std::size_t s) { return loss[s]; });
}

/// Samples farthest outside of the spheres, not two of them close together.
std::vector<std::size_t> worst_sites(const SphereFit::Reading& reading,
                                     const std::vector<SurfaceSample>& samples, double apart) {
  const std::vector<std::size_t> order = ascending(
      samples.size(), [&](std::size_t i) { return -reading.error[static_cast<Eigen::Index>(i)]; });
  std::vector<std::size_t> sites;
  for (const std::size_t i : order) {
    const bool is_apart = std::all_of(sites.begin(), sites.end(), [&](std::size_t other) {
      return (samples[i].point - samples[other].point).norm() > apart;
    });
    if (is_apart) sites.push_back(i);
    if (sites.size() == kSites) break;
  }
  return sites;
}

/// A typical distance between neighbouring spheres' parts of the surface.
double patch_size(const std::vector<SurfaceSample>& samples, std::size_t spheres) {
  Eigen::AlignedBox3d bounds;
  for (const SurfaceSample& sample : samples) bounds.extend(sample.point);
  return bounds.diagonal().norm() / (2 * std::sqrt(static_cast<double>(spheres)));
}

/// One round: tries each spared sphere in each place. @return whether the spheres became better.
bool relocate_one(const SphereFit& fit, const std::vector<SurfaceSample>& samples,
                  std::vector<ClumpSphere>& spheres, double& cost, int& attempts) {
  const double patch = patch_size(samples, spheres.size());
  const SphereFit::Reading reading = fit.read(spheres);
  const std::vector<std::size_t> spared = by_use(reading, spheres.size());
  for (const std::size_t site : worst_sites(reading, samples, patch / 2)) {
    const ClumpSphere ball = touching_ball(samples, site, patch / 4);
    if (!std::isfinite(ball.radius)) continue;
    for (std::size_t s = 0; s < std::min(kSpared, spared.size()); ++s) {
      if (attempts-- <= 0) return false;
      std::vector<ClumpSphere> moved = spheres;
      moved[spared[s]] = ball;
      double moved_cost = fit.improve(moved, kTrialIterations);
      if (moved_cost > kPromising * cost) continue;
      moved_cost = fit.improve(moved, kFinalIterations);
      if (moved_cost > kWorthwhile * cost) continue;
      spheres = std::move(moved);
      cost = moved_cost;
      return true;
    }
  }
  return false;
}

/// Puts spheres that no sample needs, and those that are still missing, where the error is largest.
void put_to_use(const SphereFit& fit, const std::vector<SurfaceSample>& samples, std::size_t count,
                std::vector<ClumpSphere>& spheres) {
  const double patch = patch_size(samples, count);
  for (std::size_t turn = 0; turn < count; ++turn) {
    const SphereFit::Reading reading = fit.read(spheres);
    std::vector<bool> is_used(spheres.size(), false);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      is_used[static_cast<std::size_t>(reading.sphere[static_cast<Eigen::Index>(i)])] = true;
    }
    const auto idle = std::find(is_used.begin(), is_used.end(), false);
    if (idle == is_used.end() && spheres.size() == count) return;
    const ClumpSphere ball =
        touching_ball(samples, worst_sites(reading, samples, patch).front(), patch / 4);
    if (!std::isfinite(ball.radius)) return;
    if (idle != is_used.end()) {
      spheres[static_cast<std::size_t>(idle - is_used.begin())] = ball;
    } else {
      spheres.push_back(ball);
    }
    fit.improve(spheres, kTrialIterations);
  }
}

}  // namespace

void relocate_and_fit(const SphereFit& fit, const std::vector<SurfaceSample>& samples,
                      std::size_t count, std::vector<ClumpSphere>& spheres) {
  fit.improve(spheres, kFirstIterations);
  put_to_use(fit, samples, count, spheres);
  double cost = fit.improve(spheres, kFirstIterations);
  int attempts = attempts_for(spheres.size());
  while (relocate_one(fit, samples, spheres, cost, attempts)) {
  }
}

}  // namespace repose::dem
