#include "dem/engine/lanes.h"

#include <random>

#include <gtest/gtest.h>

#include "dem/engine/contact_force.h"

namespace repose::dem {
namespace {

Double4 lanes_of(double a, double b, double c, double d) { return Double4::Vector4{a, b, c, d}; }

TEST(Double4, EachLaneIsOnItsOwn) {
  const Double4 x = lanes_of(1, 4, 9, 16);
  const Double4 roots = sqrt(x);
  const Double4 chosen = select(x > Double4(5), x, -x);
  for (std::size_t k = 0; k < kLanes; ++k) {
    EXPECT_EQ(roots[k], static_cast<double>(k + 1));
    EXPECT_EQ(chosen[k], k < 2 ? -x[k] : x[k]);
    EXPECT_EQ(abs(-x)[k], x[k]);
  }
}

TEST(Double4, AnyIsTrueOfOneLaneAlone) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    Double4 x(0);
    x.set(k, 1);
    EXPECT_TRUE(any(x > Double4(.5)));
  }
  EXPECT_FALSE(any(Double4(0) > Double4(.5)));
}

TEST(Double4, TurningRowsTwiceGivesThemBack) {
  Rows rows;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto first = static_cast<double>(10 * k);
    rows.row[k] = lanes_of(first, first + 1, first + 2, first + 3);
  }
  const Columns columns = columns_of(rows);
  EXPECT_EQ(columns.xyz.y[3], 31);
  EXPECT_EQ(columns.w[1], 13);
  const Rows back = rows_of(columns.xyz, columns.w);
  for (std::size_t k = 0; k < kLanes; ++k) {
    for (std::size_t i = 0; i < kLanes; ++i) EXPECT_EQ(back.row[k][i], rows.row[k][i]);
  }
}

/// A contact with random overlap, velocities and springs.
struct Case {
  ContactGeometry<double> touch;
  Springs<double> springs;
};

Case random_case(std::mt19937& random) {
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0 - .5; };
  const auto vector = [&](double size) -> Vec3<double> {
    return {size * uniform(), size * uniform(), size * uniform()};
  };
  Case one;
  const Vector normal = Vector{uniform(), uniform(), uniform() + 2}.normalized();
  one.touch.normal = triple_of(normal);
  one.touch.overlap = 1e-6 * (1 + uniform());
  one.touch.reduced_radius = .002;
  one.touch.reduced_mass = 1e-4;
  one.touch.damper_limit = 10;
  one.touch.max_stable_damping = 8;
  one.touch.half_velocity = vector(2);
  one.touch.velocity = vector(random() % 4 == 0 ? 4 : .01);  // short and long impacts
  one.touch.twist = uniform();
  if (random() % 4 != 0) one.springs = {vector(1e-2), 1e-4 * (1 + uniform())};
  return one;
}

TEST(Double4, ContactForceIsTheSameAloneAsWithThreeOthers) {
  const ContactLaw law = {.reduced_young_pa = 1e9,
                          .reduced_shear_pa = 2e8,
                          .normal_damping = .3,
                          .tangential_damping = .2,
                          .sliding_friction = .4,
                          .rolling_friction = 0};
  std::mt19937 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    ContactGeometry<Double4> touches;
    Springs<Double4> all_springs;
    std::array<Case, kLanes> cases;
    const auto set = [](Vec3<Double4>& to, std::size_t k, const Vec3<double>& from) {
      to.x.set(k, from.x);
      to.y.set(k, from.y);
      to.z.set(k, from.z);
    };
    for (std::size_t k = 0; k < kLanes; ++k) {
      cases[k] = random_case(random);
      const ContactGeometry<double>& touch = cases[k].touch;
      set(touches.normal, k, touch.normal);
      touches.overlap.set(k, touch.overlap);
      touches.reduced_radius.set(k, touch.reduced_radius);
      touches.reduced_mass.set(k, touch.reduced_mass);
      touches.damper_limit.set(k, touch.damper_limit);
      touches.max_stable_damping.set(k, touch.max_stable_damping);
      set(touches.half_velocity, k, touch.half_velocity);
      set(touches.velocity, k, touch.velocity);
      touches.twist.set(k, touch.twist);
      set(all_springs.tangential, k, cases[k].springs.tangential);
      all_springs.radius.set(k, cases[k].springs.radius);
    }
    const auto together = contact_force(touches, law_of<Double4>(law), 1e-6, all_springs);
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto alone = contact_force(cases[k].touch, law_of<double>(law), 1e-6, cases[k].springs);
      EXPECT_EQ(together.normal[k], alone.normal);
      EXPECT_EQ(together.total.x[k], alone.total.x);
      EXPECT_EQ(together.total.z[k], alone.total.z);
      EXPECT_EQ(all_springs.tangential.y[k], cases[k].springs.tangential.y);
      EXPECT_EQ(all_springs.radius[k], cases[k].springs.radius);
    }
  }
}

}  // namespace
}  // namespace repose::dem
