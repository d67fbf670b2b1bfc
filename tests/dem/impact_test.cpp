#include <cmath>

#include <gtest/gtest.h>

#include "dem/engine/contact_force.h"

namespace repose::dem {
namespace {

constexpr double kTimestep = 1e-6;

Law<double> glass_law(double restitution, double friction) {
  const Material glass{
      .name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 6e10, .poisson_ratio = .24};
  const PairCoefficients pair{.restitution = restitution, .sliding_friction = friction};
  return dem::law_of<double>(ContactTable({glass}, {pair}, RollingModel::none).law(0, 0));
}

/// At rest, b above a.
ContactGeometry<double> touch_of(double overlap) {
  ContactGeometry<double> touch;
  touch.normal = {0, 0, 1};
  touch.overlap = overlap;
  touch.reduced_radius = .002;
  touch.reduced_mass = 1e-4;
  touch.damper_limit = 1e300;
  touch.max_stable_damping = 1e300;
  return touch;
}

/// b's surface slides by `slip` in one step.
ContactForce<double> slide(ContactGeometry<double> touch, const Vec3<double>& slip,
                           const Law<double>& law, Springs<double>& springs) {
  touch.half_velocity = slip * (1 / kTimestep);
  return contact_force(touch, law, kTimestep, springs);
}

double tangential_stiffness(const ContactGeometry<double>& touch, const Law<double>& law) {
  return 8 * law.reduced_shear * std::sqrt(touch.reduced_radius * touch.overlap);
}

TEST(ContactForce, NormalPushIsHertzs) {
  const Law<double> law = glass_law(1, 0);
  Springs<double> springs;
  const ContactForce<double> force = contact_force(touch_of(1e-6), law, kTimestep, springs);
  EXPECT_DOUBLE_EQ(force.normal,
                   4.0 / 3 * law.reduced_young * std::sqrt(.002) * std::pow(1e-6, 1.5));
  EXPECT_DOUBLE_EQ(force.total.z, -force.normal);
}

TEST(ContactForce, DoublingOverlapMultipliesForceBy2Root2) {
  const Law<double> law = glass_law(1, 0);
  Springs<double> springs;
  const double one = contact_force(touch_of(1e-6), law, kTimestep, springs).normal;
  const double two = contact_force(touch_of(2e-6), law, kTimestep, springs).normal;
  EXPECT_NEAR(two / one, 2 * std::sqrt(2.0), 1e-12);
}

TEST(ContactForce, ModuliAreThoseOfThePair) {
  const Law<double> law = glass_law(1, 0);
  EXPECT_NEAR(law.reduced_young, 6e10 / (2 * (1 - .24 * .24)), 1);
  EXPECT_NEAR(law.reduced_shear, 6e10 / (4 * (2 - .24) * (1 + .24)), 1);
}

TEST(ContactForce, FastPartingDoesNotPull) {
  ContactGeometry<double> touch = touch_of(1e-6);
  touch.velocity.z = 100;  // b flies off
  Springs<double> springs;
  const ContactForce<double> force = contact_force(touch, glass_law(.1, .5), kTimestep, springs);
  EXPECT_EQ(force.normal, 0);
  EXPECT_EQ(force.total.squared_norm(), 0);
}

TEST(ContactForce, SmallSlipStretchesMindlinsSpring) {
  const Law<double> law = glass_law(1, 1);
  const ContactGeometry<double> touch = touch_of(1e-6);
  Springs<double> springs;
  const ContactForce<double> force = slide(touch, {1e-9, 0, 0}, law, springs);
  EXPECT_NEAR(force.total.x, tangential_stiffness(touch, law) * 1e-9, 1e-12);  // a is dragged along
  const ContactForce<double> back = slide(touch, {-1e-9, 0, 0}, law, springs);
  EXPECT_NEAR(back.total.x, 0, 1e-15);
}

TEST(ContactForce, SlidingStopsAtCoulombsLimit) {
  const Law<double> law = glass_law(.5, .3);
  Springs<double> springs;
  const ContactForce<double> force = slide(touch_of(1e-6), {3e-5, 4e-5, 0}, law, springs);
  EXPECT_NEAR(std::hypot(force.total.x, force.total.y), .3 * force.normal, 1e-12);
  EXPECT_NEAR(std::sqrt(springs.tangential.squared_norm()), .3 * force.normal,
              1e-12);  // the spring is limited too
  EXPECT_NEAR(force.total.y / force.total.x, 4.0 / 3, 1e-9);
}

TEST(ContactForce, DamperDoesNotPassCoulombsLimit) {
  ContactGeometry<double> touch = touch_of(1e-6);
  touch.velocity.x = 1e3;
  Springs<double> springs;
  const ContactForce<double> force = contact_force(touch, glass_law(.2, .3), kTimestep, springs);
  EXPECT_NEAR(std::hypot(force.total.x, force.total.y), .3 * force.normal, 1e-12);
}

TEST(ContactForce, UnloadingShrinksTheSpringAndLoadingLeavesIt) {
  const Law<double> law = glass_law(1, 1);
  Springs<double> springs;
  slide(touch_of(4e-6), {1e-9, 0, 0}, law, springs);
  const double stretched = springs.tangential.x;
  contact_force(touch_of(1e-6), law, kTimestep, springs);  // half the contact radius
  EXPECT_NEAR(springs.tangential.x, stretched / 2, 1e-12);
  contact_force(touch_of(4e-6), law, kTimestep, springs);
  EXPECT_NEAR(springs.tangential.x, stretched / 2, 1e-12);
}

TEST(ContactForce, SpringTurnsWithTheContact) {
  const Law<double> law = glass_law(1, 1);
  Springs<double> springs;
  slide(touch_of(1e-6), {3e-9, 4e-9, 0}, law, springs);
  const double size = std::sqrt(springs.tangential.squared_norm());
  ContactGeometry<double> turned = touch_of(1e-6);
  turned.normal = {std::sin(.1), 0, std::cos(.1)};
  contact_force(turned, law, kTimestep, springs);
  EXPECT_NEAR(std::sqrt(springs.tangential.squared_norm()), size, 1e-12 * size);
  EXPECT_NEAR(springs.tangential.dot(turned.normal), 0, 1e-12 * size);
}

TEST(ContactForce, SpringTurnsWithSpinAboutTheNormal) {
  const Law<double> law = glass_law(1, 1);
  Springs<double> springs;
  slide(touch_of(1e-6), {1e-9, 0, 0}, law, springs);
  ContactGeometry twisting = touch_of(1e-6);
  constexpr int kSteps = 1000;
  twisting.twist = .5 / (kSteps * kTimestep);  // half a radian in all
  for (int k = 0; k < kSteps; ++k) contact_force(twisting, law, kTimestep, springs);
  EXPECT_NEAR(std::atan2(springs.tangential.y, springs.tangential.x), .5, 1e-3);
}

/// Work done by a contact on a closed path of (overlap, slip), in small steps.
double work_given(const std::vector<Eigen::Vector2d>& corners) {
  const Law<double> law = glass_law(1, 10);
  Springs<double> springs;
  double work = 0;
  constexpr int kSteps = 2000;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Eigen::Vector2d step = (corners[k + 1] - corners[k]) / kSteps;
    for (int s = 0; s < kSteps; ++s) {
      const Eigen::Vector2d middle = corners[k] + (s + .5) * step;
      const double before = springs.tangential.x;
      const ContactForce<double> force =
          slide(touch_of(middle.x()), {step.y(), 0, 0}, law, springs);
      work -= force.normal * step.x() + (before + springs.tangential.x) / 2 * step.y();
    }
  }
  return work;
}

// Thornton's rescaling on unloading: a spring based on the total slip fails one of these.
TEST(ContactForce, NoCycleOfLoadAndSlipMakesEnergy) {
  constexpr double kLow = 1e-6;
  constexpr double kHigh = 4e-6;
  constexpr double kSlip = 1e-7;
  const double scale = kSlip * kSlip;  // of the spring's energy, times its stiffness
  const double stiffness = tangential_stiffness(touch_of(kHigh), glass_law(1, 10));
  const double unloaded_sheared =
      work_given({{kHigh, 0}, {kHigh, kSlip}, {kLow, kSlip}, {kLow, 0}, {kHigh, 0}});
  const double loaded_sheared =
      work_given({{kLow, 0}, {kLow, kSlip}, {kHigh, kSlip}, {kHigh, 0}, {kLow, 0}});
  EXPECT_LT(unloaded_sheared, 1e-3 * stiffness * scale);
  EXPECT_LT(loaded_sheared, 1e-3 * stiffness * scale);
}

}  // namespace
}  // namespace repose::dem
