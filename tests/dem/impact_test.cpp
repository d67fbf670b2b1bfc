#include <cmath>

#include <gtest/gtest.h>

#include "dem/engine/contact_force.h"

namespace repose::dem {
namespace {

constexpr double kTimestep = 1e-6;

ContactLaw law_of(double restitution, double friction) {
  const Material glass{
      .name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 6e10, .poisson_ratio = .24};
  const PairCoefficients pair{.restitution = restitution, .sliding_friction = friction};
  return ContactTable({glass}, {pair}, RollingModel::none).law(0, 0);
}

/// At rest, b above a.
Touch touch_of(double overlap) {
  Touch touch;
  touch.normal = Vector::UnitZ();
  touch.overlap = overlap;
  touch.reduced_radius = .002;
  touch.reduced_mass = 1e-4;
  touch.half_velocity = Vector::Zero();
  touch.velocity = Vector::Zero();
  return touch;
}

/// b's surface slides by `slip` in one step.
ContactForce slide(Touch touch, const Vector& slip, const ContactLaw& law, ContactMemory& memory) {
  touch.half_velocity = slip / kTimestep;
  return contact_force(touch, law, kTimestep, memory);
}

double tangential_stiffness(const Touch& touch, const ContactLaw& law) {
  return 8 * law.reduced_shear_pa * std::sqrt(touch.reduced_radius * touch.overlap);
}

TEST(ContactForce, NormalPushIsHertzs) {
  const ContactLaw law = law_of(1, 0);
  ContactMemory memory;
  const ContactForce force = contact_force(touch_of(1e-6), law, kTimestep, memory);
  EXPECT_DOUBLE_EQ(force.normal,
                   4.0 / 3 * law.reduced_young_pa * std::sqrt(.002) * std::pow(1e-6, 1.5));
  EXPECT_DOUBLE_EQ(force.total.z(), -force.normal);
}

TEST(ContactForce, DoublingOverlapMultipliesForceBy2Root2) {
  const ContactLaw law = law_of(1, 0);
  ContactMemory memory;
  const double one = contact_force(touch_of(1e-6), law, kTimestep, memory).normal;
  const double two = contact_force(touch_of(2e-6), law, kTimestep, memory).normal;
  EXPECT_NEAR(two / one, 2 * std::sqrt(2.0), 1e-12);
}

TEST(ContactForce, ModuliAreThoseOfThePair) {
  const ContactLaw law = law_of(1, 0);
  EXPECT_NEAR(law.reduced_young_pa, 6e10 / (2 * (1 - .24 * .24)), 1);
  EXPECT_NEAR(law.reduced_shear_pa, 6e10 / (4 * (2 - .24) * (1 + .24)), 1);
}

TEST(ContactForce, FastPartingDoesNotPull) {
  Touch touch = touch_of(1e-6);
  touch.velocity.z() = 100;  // b flies off
  ContactMemory memory;
  const ContactForce force = contact_force(touch, law_of(.1, .5), kTimestep, memory);
  EXPECT_EQ(force.normal, 0);
  EXPECT_EQ(force.total.norm(), 0);
}

TEST(ContactForce, SmallSlipStretchesMindlinsSpring) {
  const ContactLaw law = law_of(1, 1);
  const Touch touch = touch_of(1e-6);
  ContactMemory memory;
  const ContactForce force = slide(touch, {1e-9, 0, 0}, law, memory);
  EXPECT_NEAR(force.total.x(), tangential_stiffness(touch, law) * 1e-9, 1e-12);  // a is dragged
  const ContactForce back = slide(touch, {-1e-9, 0, 0}, law, memory);
  EXPECT_NEAR(back.total.x(), 0, 1e-15);
}

TEST(ContactForce, SlidingStopsAtCoulombsLimit) {
  const ContactLaw law = law_of(.5, .3);
  ContactMemory memory;
  const ContactForce force = slide(touch_of(1e-6), {3e-5, 4e-5, 0}, law, memory);
  EXPECT_NEAR(force.total.head<2>().norm(), .3 * force.normal, 1e-12);
  EXPECT_NEAR(memory.tangential.norm(), .3 * force.normal, 1e-12);  // the spring is cut off too
  EXPECT_NEAR(force.total.y() / force.total.x(), 4.0 / 3, 1e-9);
}

TEST(ContactForce, DamperDoesNotPassCoulombsLimit) {
  Touch touch = touch_of(1e-6);
  touch.velocity.x() = 1e3;
  ContactMemory memory;
  const ContactForce force = contact_force(touch, law_of(.2, .3), kTimestep, memory);
  EXPECT_NEAR(force.total.head<2>().norm(), .3 * force.normal, 1e-12);
}

TEST(ContactForce, UnloadingShrinksTheSpringAndLoadingLeavesIt) {
  const ContactLaw law = law_of(1, 1);
  ContactMemory memory;
  slide(touch_of(4e-6), {1e-9, 0, 0}, law, memory);
  const double stretched = memory.tangential.x();
  contact_force(touch_of(1e-6), law, kTimestep, memory);  // half the contact radius
  EXPECT_NEAR(memory.tangential.x(), stretched / 2, 1e-12);
  contact_force(touch_of(4e-6), law, kTimestep, memory);
  EXPECT_NEAR(memory.tangential.x(), stretched / 2, 1e-12);
}

TEST(ContactForce, SpringTurnsWithTheContact) {
  const ContactLaw law = law_of(1, 1);
  ContactMemory memory;
  slide(touch_of(1e-6), {3e-9, 4e-9, 0}, law, memory);
  const double size = memory.tangential.norm();
  Touch turned = touch_of(1e-6);
  turned.normal = Vector(std::sin(.1), 0, std::cos(.1));
  contact_force(turned, law, kTimestep, memory);
  EXPECT_NEAR(memory.tangential.norm(), size, 1e-12 * size);
  EXPECT_NEAR(memory.tangential.dot(turned.normal), 0, 1e-12 * size);
}

TEST(ContactForce, SpringTurnsWithSpinAboutTheNormal) {
  const ContactLaw law = law_of(1, 1);
  ContactMemory memory;
  slide(touch_of(1e-6), {1e-9, 0, 0}, law, memory);
  Touch twisting = touch_of(1e-6);
  constexpr int kSteps = 1000;
  twisting.twist = .5 / (kSteps * kTimestep);  // half a radian in all
  for (int k = 0; k < kSteps; ++k) contact_force(twisting, law, kTimestep, memory);
  EXPECT_NEAR(std::atan2(memory.tangential.y(), memory.tangential.x()), .5, 1e-3);
}

/// Work that a contact gives out on a closed path of (overlap, slip), in small steps.
double work_given(const std::vector<Eigen::Vector2d>& corners) {
  const ContactLaw law = law_of(1, 10);
  ContactMemory memory;
  double work = 0;
  constexpr int kSteps = 2000;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Eigen::Vector2d step = (corners[k + 1] - corners[k]) / kSteps;
    for (int s = 0; s < kSteps; ++s) {
      const Eigen::Vector2d middle = corners[k] + (s + .5) * step;
      const double before = memory.tangential.x();
      const ContactForce force = slide(touch_of(middle.x()), {step.y(), 0, 0}, law, memory);
      work -= force.normal * step.x() + (before + memory.tangential.x()) / 2 * step.y();
    }
  }
  return work;
}

// Thornton's rescaling on unloading: a spring of the total slip fails one of these.
TEST(ContactForce, NoCycleOfLoadAndSlipMakesEnergy) {
  constexpr double kLow = 1e-6;
  constexpr double kHigh = 4e-6;
  constexpr double kSlip = 1e-7;
  const double scale = kSlip * kSlip;  // of the spring's energy, times its stiffness
  const double stiffness = tangential_stiffness(touch_of(kHigh), law_of(1, 10));
  const double unloaded_sheared =
      work_given({{kHigh, 0}, {kHigh, kSlip}, {kLow, kSlip}, {kLow, 0}, {kHigh, 0}});
  const double loaded_sheared =
      work_given({{kLow, 0}, {kLow, kSlip}, {kHigh, kSlip}, {kHigh, 0}, {kLow, 0}});
  EXPECT_LT(unloaded_sheared, 1e-3 * stiffness * scale);
  EXPECT_LT(loaded_sheared, 1e-3 * stiffness * scale);
}

}  // namespace
}  // namespace repose::dem
