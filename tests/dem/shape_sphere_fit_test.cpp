#include <cmath>

#include <gmock/gmock.h>

#include "dem/shape/clump/sphere_fit.h"
#include "dem/shape/clump/surface.h"

namespace repose::testing {
namespace {

using dem::ClumpSphere;
using dem::SphereFit;
using dem::SurfaceSample;
using dem::Vector;

std::vector<SurfaceSample> samples_of(const std::vector<ClumpSphere>& spheres) {
  std::vector<SurfaceSample> samples;
  for (const auto& point : dem::sample_union(spheres, 1500)) {
    samples.push_back({.point = point.point, .normal = Vector::Zero()});
  }
  return samples;
}

TEST(SphereFit, FindsASphereFromAPoorStart) {
  const std::vector<ClumpSphere> truth = {{{0.3, -0.2, 0.1}, 1.5}};
  const SphereFit fit(samples_of(truth), {}, 0.01);
  std::vector<ClumpSphere> spheres = {{{1, 0.5, -0.4}, 0.3}};
  EXPECT_LT(fit.improve(spheres, 100), 1e-15);
  EXPECT_LT((spheres[0].centre - truth[0].centre).norm(), 1e-6);
  EXPECT_NEAR(spheres[0].radius, 1.5, 1e-6);
}

TEST(SphereFit, FindsThreeOverlappingSpheres) {
  const std::vector<ClumpSphere> truth = {
      {{-1, 0, 0}, 1}, {{0, 0.2, 0}, 1.2}, {{1.1, 0, 0.1}, 0.8}};
  const SphereFit fit(samples_of(truth), {}, 0.01);
  std::vector<ClumpSphere> spheres = {
      {{-0.7, 0.1, 0}, 0.7}, {{0.1, 0, 0}, 0.9}, {{0.8, 0, 0}, 0.6}};
  EXPECT_LT(fit.improve(spheres, 300), 1e-12);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT((spheres[i].centre - truth[i].centre).norm(), 1e-4) << i;
    EXPECT_NEAR(spheres[i].radius, truth[i].radius, 1e-4) << i;
  }
}

TEST(SphereFit, NeverGetsWorse) {
  const SphereFit fit(samples_of({{{0, 0, 0}, 1}, {{1.5, 0, 0}, 0.5}}), {}, 0.01);
  std::vector<ClumpSphere> spheres = {{{0, 0, 0.5}, 2}, {{0.1, 0, 0}, 0.02}};
  double last = fit.read(spheres).cost;
  for (int i = 0; i < 20; ++i) {
    const double cost = fit.improve(spheres, 1);
    EXPECT_LE(cost, last);
    last = cost;
  }
}

TEST(SphereFit, PointsOutsidePushASphereAwayThatReachesThem) {
  // A flat patch can be touched equally well from either side; the points above it rule one out.
  std::vector<SurfaceSample> patch;
  std::vector<SphereFit::Guard> above;
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      patch.push_back({.point = Vector(0.02 * x, 0.02 * y, 0), .normal = Vector::UnitZ()});
      above.push_back({Vector(0.02 * x, 0.02 * y, 0.3), 0.3});
    }
  }
  std::vector<ClumpSphere> spheres = {{{0, 0, 1}, 1}};
  EXPECT_GT(SphereFit(patch, above, 0.01).read(spheres).cost,
            100 * SphereFit(patch, {}, 0.01).read(spheres).cost);
  SphereFit(patch, above, 0.01).improve(spheres, 200);
  EXPECT_LT(spheres[0].centre.z() + spheres[0].radius, 0.3);
}

TEST(SphereFit, ReadsTheNearestAndTheSecondNearestSphere) {
  const SphereFit fit({{.point = Vector(3, 0, 0), .normal = Vector::UnitX()}}, {}, 0.01);
  const auto reading = fit.read({{{-1, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 4, 0}, 3.5}});
  EXPECT_DOUBLE_EQ(reading.error[0], 1.5);
  EXPECT_DOUBLE_EQ(reading.second_error[0], 2);
  EXPECT_EQ(reading.sphere[0], 2);
}

}  // namespace
}  // namespace repose::testing
