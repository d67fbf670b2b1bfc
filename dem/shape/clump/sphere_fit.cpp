#include "dem/shape/clump/sphere_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

namespace repose::dem {

namespace {

using Block = Eigen::Matrix4d;
using Step = Eigen::Vector4d;

constexpr double kFirstDamping = 1e-2;
constexpr double kMinDamping = 1e-6;
constexpr double kLargestDamping = 1e8;
constexpr double kConverged = 1e-7;  // fraction of the cost that a step must save

struct Normal {
  Block block = Block::Zero();
  Step gradient = Step::Zero();
};

std::vector<ClumpSphere> stepped(const std::vector<ClumpSphere>& spheres,
                                 const std::vector<Normal>& normals, double damping,
                                 double smallest_radius) {
  std::vector<ClumpSphere> moved = spheres;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const double points = normals[s].block(3, 3);
    if (points > 0) {
      const Block damped = normals[s].block + damping * points * Block::Identity();
      const Step step = damped.ldlt().solve(normals[s].gradient);
      moved[s].centre -= step.head<3>();
      moved[s].radius -= step[3];
    }
    moved[s].radius = std::max(smallest_radius, moved[s].radius);
  }
  return moved;
}

}  // namespace

SphereFit::SphereFit(const std::vector<SurfaceSample>& samples, const std::vector<Guard>& guards,
                     double smallest_radius_m)
    : samples_(samples.size()), smallest_radius_(smallest_radius_m) {
  const auto count = static_cast<Eigen::Index>(samples.size() + guards.size());
  x_.resize(count);
  y_.resize(count);
  z_.resize(count);
  least_ = Eigen::ArrayXd::Zero(count);
  const auto place = [&](std::size_t i, const Vector& point, double height) {
    const auto index = static_cast<Eigen::Index>(i);
    x_[index] = point.x();
    y_[index] = point.y();
    z_[index] = point.z();
    least_[index] = height;
  };
  for (std::size_t i = 0; i < samples.size(); ++i) place(i, samples[i].point, 0);
  for (std::size_t i = 0; i < guards.size(); ++i) {
    place(samples.size() + i, guards[i].point, guards[i].height_m / 3);
  }
}

SphereFit::Reading SphereFit::read(const std::vector<ClumpSphere>& spheres) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr Eigen::Index kChunk = 512;  // points that stay in the L1 cache for all spheres
  const Eigen::Index count = x_.size();
  Reading reading{.error = Eigen::ArrayXd::Constant(count, kFar),
                  .second_error = Eigen::ArrayXd::Constant(count, kFar),
                  .sphere = Eigen::ArrayXd::Zero(count)};
  Eigen::ArrayXd distance(kChunk);
  for (Eigen::Index first = 0; first < count; first += kChunk) {
    const Eigen::Index points = std::min(kChunk, count - first);
    double* const nearest = &reading.error[first];
    double* const second = &reading.second_error[first];
    double* const sphere = &reading.sphere[first];
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      const Vector& centre = spheres[s].centre;
      distance.head(points) = ((x_.segment(first, points) - centre.x()).square() +
                               (y_.segment(first, points) - centre.y()).square() +
                               (z_.segment(first, points) - centre.z()).square())
                                  .sqrt() -
                              spheres[s].radius;
      const auto number = static_cast<double>(s);
      for (Eigen::Index i = 0; i < points; ++i) {
        const double f = distance[i], best = nearest[i];
        sphere[i] = f < best ? number : sphere[i];
        second[i] = std::min(second[i], std::max(best, f));
        nearest[i] = std::min(best, f);
      }
    }
  }
  const Eigen::Index guards = count - static_cast<Eigen::Index>(samples_);
  for (Eigen::ArrayXd* error : {&reading.error, &reading.second_error}) {
    error->tail(guards) = (error->tail(guards) - least_.tail(guards)).min(0);
  }
  reading.cost = reading.error.square().sum() / static_cast<double>(samples_);
  return reading;
}

double SphereFit::improve(std::vector<ClumpSphere>& spheres, int iterations) const {
  spheres = stepped(spheres, std::vector<Normal>(spheres.size()), 0, smallest_radius_);
  Reading reading = read(spheres);
  double damping = kFirstDamping;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    std::vector<Normal> normals(spheres.size());
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      if (reading.error[i] == 0) continue;
      const auto s = static_cast<std::size_t>(reading.sphere[i]);
      const Vector way = spheres[s].centre - Vector(x_[i], y_[i], z_[i]);
      const double distance = way.norm();
      if (distance <= 0) continue;  // the point is the centre: no direction
      Step slope;
      slope << way / distance, -1;
      normals[s].block.noalias() += slope * slope.transpose();
      normals[s].gradient += reading.error[i] * slope;
    }
    bool is_better = false;
    double saved = 0;
    while (!is_better && damping < kLargestDamping) {
      std::vector<ClumpSphere> moved = stepped(spheres, normals, damping, smallest_radius_);
      Reading moved_reading = read(moved);
      is_better = moved_reading.cost < reading.cost;
      damping = is_better ? std::max(damping / 5, kMinDamping) : damping * 4;
      if (!is_better) continue;
      saved = 1 - moved_reading.cost / reading.cost;
      spheres = std::move(moved);
      reading = std::move(moved_reading);
    }
    if (!is_better || saved <= kConverged) break;
  }
  return reading.cost;
}

namespace {

constexpr int kFirstIterations = 200;
constexpr int kTrialIterations = 15;
constexpr int kFinalIterations = 50;
constexpr double kPromising =
    1.02;  // relative to the best cost, after the first iterations of a trial
constexpr double kWorthwhile = 1 - 5e-3;
constexpr std::size_t kSpared = 4;  // spheres tried elsewhere
constexpr std::size_t kSites = 6;   // places tried

int attempts_for(std::size_t spheres) {
  constexpr std::size_t kWork = 5000, kFewest = 30, kMax = 200;
  return static_cast<int>(std::clamp(kWork / spheres, kFewest, kMax));
}

/// The largest ball inside that touches the surface at sample `at`, estimated from the samples.
///
///     r = min over the samples q of |p - q|^2 / (2 n.(p - q))
///
/// Source: Ma, Bae & Choi, 3D medial axis point approximation using nearest neighbors and the
/// normal field, Vis. Comput. 28 (2012) 7-19. Samples closer than `grain` reflect noise rather than
/// shape and are ignored.
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

/// Indices by ascending value, stable.
template <typename Value>
std::vector<std::size_t> ascending(std::size_t count, Value value) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
  return order;
}

/// Spheres by ascending increase of the cost without them.
std::vector<std::size_t> by_use(const SphereFit::Reading& reading, std::size_t count) {
  std::vector<double> loss(count, 0);
  for (Eigen::Index i = 0; i < reading.sphere.size(); ++i) {
    const auto sphere = static_cast<std::size_t>(reading.sphere[i]);
    const double with = reading.error[i], without = reading.second_error[i];
    loss[sphere] += without * without - with * with;
  }
  return ascending(count, [&](std::size_t s) { return loss[s]; });
}

/// Samples farthest outside the spheres, no two of them close together.
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

/// Typical distance between the surface patches of neighbouring spheres.
double patch_size(const std::vector<SurfaceSample>& samples, std::size_t spheres) {
  Eigen::AlignedBox3d bounds;
  for (const SurfaceSample& sample : samples) bounds.extend(sample.point);
  return bounds.diagonal().norm() / (2 * std::sqrt(static_cast<double>(spheres)));
}

/// One round: tries each dispensable sphere in each place. @return whether the spheres improved.
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

/// Puts spheres that no sample needs, and missing ones, where the error is largest.
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
