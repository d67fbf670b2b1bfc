#include "dem/engine/near_spheres.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

constexpr double kReach_m = .01;
constexpr double kTimestep_s = 1e-5;

GrainKind kind_of(int spheres, Random& random) {
  GrainKind kind;
  kind.shape.volume_m3 = 1e-6;
  kind.shape.gyration_m2 = Vector::Constant(1e-5);
  for (int k = 0; k < spheres; ++k) {
    const double radius = kReach_m * (.1 + .4 * random.uniform());
    const Vector towards = random.orientation() * Vector::UnitX();
    kind.shape.spheres.push_back(
        {.centre = (kReach_m - radius) * random.uniform() * towards, .radius = radius});
  }
  return kind;
}

/// Two bodies whose surfaces are close to each other, with their margins and sphere columns.
struct Pair {
  Bodies bodies;
  Margins margins;
  SphereColumns columns;

  Pair(const Vector& place, int spheres, Random& random) {
    const GrainKind kind = kind_of(spheres, random);
    const Vector away = random.orientation() * Vector::UnitX();
    for (const double at : {0.0, kReach_m * (.5 + 1.6 * random.uniform())}) {
      const Grain grain{.position = place + at * away,
                        .orientation = random.orientation(),
                        .velocity = 10 * random.uniform() * away};
      add_body(bodies, grain, kind, 1000);
    }
    margins.resize(bodies);
    columns.resize(bodies.spheres.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      margins.renew(bodies, k, kTimestep_s);
      columns.take_in(bodies, k);
    }
  }

  std::vector<NearSpheres> near() const {
    std::vector<NearSpheres> all;
    columns.add_near(bodies, margins, 0, 1, all);
    return all;
  }

  double gap_m(int a, int b) const {
    const PlacedSphere& one = bodies.spheres[static_cast<std::size_t>(a)];
    const PlacedSphere& other = bodies.spheres[static_cast<std::size_t>(b)];
    return (one.centre - other.centre).norm() - one.radius - other.radius;
  }
};

class NearSpheresOf : public ::testing::TestWithParam<int> {};

TEST_P(NearSpheresOf, AreAllThatMayTouchInOrderAndHardlyAnyOthers) {
  Random random(1);
  int found = 0;
  for (const Vector& place : {Vector(0, 0, 0), Vector(1000, -3, 7)}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Pair pair(place, GetParam(), random);
      const double margin_m = pair.margins.margin_m(0) + pair.margins.margin_m(1);
      const std::vector<NearSpheres> near = pair.near();
      const auto is_before = [](const NearSpheres& x, const NearSpheres& y) {
        return std::tie(x.a, x.b) < std::tie(y.a, y.b);
      };
      EXPECT_TRUE(std::is_sorted(near.begin(), near.end(), is_before));
      for (const NearSpheres& spheres : near) {
        EXPECT_LT(pair.gap_m(spheres.a, spheres.b), margin_m + 1e-5 * kReach_m);
      }
      for (int a = 0; a < GetParam(); ++a) {
        for (int b = GetParam(); b < 2 * GetParam(); ++b) {
          if (pair.gap_m(a, b) >= margin_m) continue;
          const NearSpheres wanted{.a = a, .b = b};
          EXPECT_TRUE(std::binary_search(near.begin(), near.end(), wanted, is_before));
          ++found;
        }
      }
    }
  }
  EXPECT_GT(found, 5);
}

INSTANTIATE_TEST_SUITE_P(Clumps, NearSpheresOf, ::testing::Values(1, 7, 16, 17, 40));

}  // namespace
}  // namespace repose::dem
