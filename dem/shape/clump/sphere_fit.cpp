#include "dem/shape/clump/sphere_fit.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

namespace repose::dem {
namespace {

using Block = Eigen::Matrix4d;
using Step = Eigen::Vector4d;

constexpr double kFirstDamping = 1e-2;
constexpr double kMinDamping = 1e-6;
constexpr double kLargestDamping = 1e8;
constexpr double kConverged = 1e-7;  // share of the cost that a step must save

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
  constexpr Eigen::Index kChunk = 512;  // points that stay in the fastest memory for all spheres
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

}  // namespace repose::dem
